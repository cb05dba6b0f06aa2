"""`autograder export mailmerge`: a table for a mail-merge program, or for any other system that reads CSV."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import click

from autograder.commands.export._shared import graded_options


@click.command()
@graded_options
@click.option(
    "--roster",
    type=click.Path(path_type=Path),
    metavar="CSV",
    help="The class, with the columns student_id, name and email; without it addresses stay empty.",
)
@click.option(
    "-o", "--output", "path", required=True, type=click.Path(path_type=Path), metavar="CSV", help="File to write."
)
def command(
    out: Path,
    course_file: Path | None,
    feedback: str | None,
    given: Sequence[str],
    roster: Path | None,
    path: Path,
) -> None:
    """Write one line a student: score, name, address, and the feedback in words.

    OUT is the folder of an earlier `autograder grade`. A line names no other student.

    \b
    autograder export mailmerge graded --roster class.csv -o mail.csv
    """
    from autograder.commands._people import decisions
    from autograder.commands.export._shared import say, stored
    from autograder.exports.mailmerge import mailmerge
    from autograder.problems.roster import read_roster
    from autograder.writing import write_whole

    run = stored(out, course_file, feedback)
    students = read_roster(roster) if roster is not None else []
    text, notes = mailmerge(
        run.results, students, policy=run.policy, course=run.course, later=run.later, given=decisions(given)
    )
    write_whole(path, text.encode())
    say(notes, [path])
