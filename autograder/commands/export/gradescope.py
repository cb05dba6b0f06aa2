"""`autograder export gradescope`: the autograder.zip to upload to a programming assignment."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click

from autograder.commands._people import people_options


@click.command()
@click.option(
    "--course", "course_file", type=click.Path(path_type=Path), metavar="FILE", help="Settings of the course."
)
@people_options
@click.option(
    "--seed",
    type=click.IntRange(0),
    metavar="S",
    help="Which cases are drawn. [default: the course's, or from secret and term, or 0]",
)
@click.option("--examples", type=click.IntRange(1), metavar="N", help="Cases a stage. [default: the course's]")
@click.option(
    "--feedback",
    type=click.Choice(("full", "hint", "score")),
    help="How much a failed test says. [default: the course's, at the time]",
)
@click.option(
    "--visibility",
    type=click.Choice(("visible", "after_due_date", "after_published")),
    default="visible",
    show_default=True,
    help="From when on students see their results, all of them alike.",
)
@click.option(
    "--lock", type=click.Path(path_type=Path), metavar="FILE", help="Versions to install. [default: requirements.lock]"
)
@click.option(
    "-o",
    "--output",
    "path",
    type=click.Path(path_type=Path),
    default=Path("autograder.zip"),
    metavar="ZIP",
    show_default=True,
    help="File to write.",
)
def command(
    course_file: Path | None,
    ledger: Path | None,
    roster: Path | None,
    term: str | None,
    secret_file: Path | None,
    families: Sequence[str],
    seed: int | None,
    examples: int | None,
    feedback: str | None,
    visibility: str,
    lock: Path | None,
    path: Path,
) -> None:
    """Write the autograder.zip of a programming assignment on Gradescope.

    It holds this grader, the locked versions and the rules of the course; a submission gets the same marks there as
    from `autograder grade` with the same seed. With the ledger of a release everybody is judged on the variant on
    record; without one, roster, term and secret draw the same numbers again. The secret itself is never in it.

    \b
    autograder export gradescope -o autograder.zip
    autograder export gradescope --course course.toml --seed 2026 -o autograder.zip
    autograder export gradescope --ledger release/staff/variants.csv --roster class.csv -o autograder.zip
    autograder export gradescope --term 2026S --secret-file secret.txt --roster class.csv -o autograder.zip
    """
    from autograder.commands._class import secret_of
    from autograder.commands._people import people_of
    from autograder.commands.export._shared import read, say
    from autograder.course import load_course
    from autograder.engine.exam import draw_exam
    from autograder.exports.gradescope.archive import MEMORY_MIB, Rules, autograder_zip
    from autograder.exports.gradescope.submitter import slim_roster
    from autograder.problems.ledger import ledger_text
    from autograder.writing import write_whole

    course = load_course(course_file)
    choices: dict[str, Any] = {"feedback": feedback, "visibility": visibility}
    secret = secret_of(term, secret_file)
    drawn = secret.seed(term) if secret is not None and term is not None else 0
    rules = Rules(
        seed=next(value for value in (seed, course.seed, drawn) if value is not None),
        examples=examples or course.examples,
        time_limit=course.time_limit,
        memory_mib=min(course.memory_mib, MEMORY_MIB),
        min_confinement=course.min_confinement,
        **choices,
    )
    notes = []
    people = people_of(roster, ledger, secret, term, families, course)
    students = people.students if people is not None and roster is not None else []
    known = None if people is None else people.ledger
    missing = [one.student_id for one in students if known is not None and one.student_id not in known]
    if missing:
        notes.append(f"{len(missing)} students of the roster have no variant: {', '.join(missing[:5])}.")
    data, origin = autograder_zip(
        rules,
        exam=draw_exam(rules.seed, rules.examples).data,
        course=read(course_file, "a course file") if course_file is not None else b"",
        ledger=b"" if known is None else ledger_text(known),
        roster=slim_roster(students),
        lock=lock,
    )
    write_whole(path, data)
    say([f"{path}: {len(data) / 1000:.0f} kB, with {origin}.", *notes], [path])
