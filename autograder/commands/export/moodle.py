"""`autograder export moodle`: the grading worksheet filled in, and the archive of feedback files."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import click

from autograder.commands.export._shared import graded_options

_COLUMNS = ("identifier", "grade", "maximum", "name", "email", "comments", "changeable")


def _column_options(function: click.decorators.FC) -> click.decorators.FC:
    for name in reversed(_COLUMNS):
        option = click.option(f"--{name}-column", default="", metavar="HEADING", help=f"Heading of the {name}.")
        function = option(function)
    return function


@click.command()
@graded_options
@click.option(
    "--worksheet",
    required=True,
    type=click.Path(path_type=Path),
    metavar="CSV",
    help="The grading worksheet as Moodle exported it.",
)
@click.option("--comments", is_flag=True, help="Fill in the feedback comments, too, where there are none yet.")
@click.option("--any-maximum", is_flag=True, help="Write the points even where Moodle has another maximum.")
@_column_options
@click.option(
    "-o", "--output", "folder", required=True, type=click.Path(path_type=Path), metavar="DIR", help="Where to write."
)
def command(
    out: Path,
    course_file: Path | None,
    feedback: str | None,
    given: Sequence[str],
    worksheet: Path,
    comments: bool,
    any_maximum: bool,
    folder: Path,
    **headings: str,
) -> None:
    """Fill marks into a grading worksheet of Moodle.

    OUT is the folder of an earlier `autograder grade`. In Moodle, DIR/worksheet.csv goes to "Upload grading
    worksheet" and DIR/feedback.zip to "Upload multiple feedback files in a zip". The headings of the worksheet are
    known in several languages; in another one the columns are found by what stands in them, or named here.

    \b
    autograder export moodle graded --worksheet sheet.csv -o moodle
    autograder export moodle graded --worksheet sheet.csv --grade-column Karakter -o moodle
    """
    from autograder.commands._people import decisions
    from autograder.commands.export._shared import read, stored, write
    from autograder.exports.moodle.feedback import feedback_archive
    from autograder.exports.moodle.worksheet import fill_worksheet

    run = stored(out, course_file, feedback)
    filled = fill_worksheet(
        read(worksheet, "the grading worksheet that Moodle exported"),
        worksheet.name,
        run.results,
        comments=run.texts() if comments else None,
        headings={name.removesuffix("_column"): heading for name, heading in headings.items() if heading},
        given=decisions(given),
        any_maximum=any_maximum,
    )
    owners = filled.pairs.by_line
    archive = feedback_archive(filled.folders, owners, run.pages())
    write(folder, {"worksheet.csv": filled.data, "feedback.zip": archive}, filled.notes)
