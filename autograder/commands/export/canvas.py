"""`autograder export canvas`: the exported gradebook with one column filled in, and feedback files to upload."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import click

from autograder.commands.export._shared import graded_options


@click.command()
@graded_options
@click.option(
    "--gradebook",
    required=True,
    type=click.Path(path_type=Path),
    metavar="CSV",
    help="The gradebook as Canvas exported it.",
)
@click.option("--assignment", default="", metavar="TITLE", help="Title or number of the column to fill in.")
@click.option(
    "--submissions",
    type=click.Path(path_type=Path),
    metavar="ZIP",
    help="Canvas's submissions.zip; with it feedback.zip is written, to upload there again.",
)
@click.option("--any-maximum", is_flag=True, help="Write the points even where Canvas has another maximum.")
@click.option(
    "-o", "--output", "folder", required=True, type=click.Path(path_type=Path), metavar="DIR", help="Where to write."
)
def command(
    out: Path,
    course_file: Path | None,
    feedback: str | None,
    given: Sequence[str],
    gradebook: Path,
    assignment: str,
    submissions: Path | None,
    any_maximum: bool,
    folder: Path,
) -> None:
    """Fill marks into a gradebook of Canvas.

    OUT is the folder of an earlier `autograder grade`. Export the gradebook in Canvas, and import DIR/gradebook.csv
    there again: only the column of the assignment has changed. DIR/feedback.zip goes to the assignment's page,
    "Upload Submissions".

    \b
    autograder export canvas graded --gradebook grades.csv -o canvas
    autograder export canvas graded --gradebook grades.csv --assignment "1D SLAM" \\
        --submissions submissions.zip -o canvas
    """
    from autograder.commands._people import decisions
    from autograder.commands.export._shared import read, stored, write
    from autograder.exports.bundle import names_in
    from autograder.exports.canvas.feedback import feedback_archive
    from autograder.exports.canvas.gradebook import fill_gradebook

    run = stored(out, course_file, feedback)
    filled = fill_gradebook(
        read(gradebook, "the gradebook that Canvas exported"),
        gradebook.name,
        run.results,
        assignment=assignment,
        given=decisions(given),
        any_maximum=any_maximum,
    )
    files, notes = {"gradebook.csv": filled.data}, list(filled.notes)
    if submissions is not None:
        numbers = {person.line: person.ids[0] for person in filled.people}
        owners = {numbers[line]: result for line, result in filled.pairs.by_line.items()}
        names = names_in(read(submissions, "Canvas's submissions.zip"), submissions.name)
        returned = feedback_archive(names, submissions.name, owners, run.texts())
        files["feedback.zip"] = returned.data
        notes += returned.notes
    write(folder, files, notes)
