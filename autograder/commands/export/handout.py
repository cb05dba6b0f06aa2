"""`autograder export handout`: what Moodle and Canvas need to hand a released file to each student."""

from __future__ import annotations

from pathlib import Path

import click


@click.command()
@click.argument("release", type=click.Path(path_type=Path), metavar="RELEASE")
@click.option(
    "--roster", required=True, type=click.Path(path_type=Path), metavar="CSV", help="The class, as for the release."
)
@click.option(
    "--worksheet",
    type=click.Path(path_type=Path),
    metavar="CSV",
    help="Moodle: the grading worksheet of the assignment; moodle.zip is written.",
)
@click.option(
    "--submissions",
    type=click.Path(path_type=Path),
    metavar="ZIP",
    help="Canvas: the submissions.zip of an assignment to which everybody handed in some .zip; canvas.zip is written.",
)
@click.option(
    "-o", "--output", "folder", required=True, type=click.Path(path_type=Path), metavar="DIR", help="Where to write."
)
def command(release: Path, roster: Path, worksheet: Path | None, submissions: Path | None, folder: Path) -> None:
    """Pack a release so that Moodle or Canvas hands everybody their own file.

    RELEASE is the folder of an earlier `autograder release`. In Moodle, DIR/moodle.zip goes to "Upload multiple
    feedback files in a zip"; in Canvas, DIR/canvas.zip goes to "Upload Submissions". RELEASE/staff/mail.csv is the
    table for mail merge; Gradescope hands out nothing, so mail it.

    \b
    autograder export handout release --roster class.csv --worksheet sheet.csv -o handout
    autograder export handout release --roster class.csv --submissions submissions.zip -o handout
    """
    from autograder.commands.export._shared import read, write
    from autograder.errors import UsageError
    from autograder.exports.bundle import names_in
    from autograder.exports.handout import canvas_archive, moodle_archive
    from autograder.problems.roster import read_roster

    if worksheet is None and submissions is None:
        raise UsageError(
            "Expected --worksheet (Moodle) or --submissions (Canvas); for mail merge the table is "
            f"{release / 'staff' / 'mail.csv'}."
        )
    students = read_roster(roster)
    what = "the archive of a student of the roster, as `autograder release` writes it"
    archives = {one.student_id: read(release / "zips" / f"{one.student_id}.zip", what) for one in students}
    files: dict[str, bytes] = {}
    notes: list[str] = []
    if worksheet is not None:
        sheet = read(worksheet, "the grading worksheet that Moodle exported")
        packed = moodle_archive(sheet, worksheet.name, students, archives)
        files["moodle.zip"], notes = packed.data, [*notes, *packed.notes]
    if submissions is not None:
        names = names_in(read(submissions, "Canvas's submissions.zip"), submissions.name)
        packed = canvas_archive(names, submissions.name, students, archives)
        files["canvas.zip"], notes = packed.data, [*notes, *packed.notes]
    write(folder, files, notes)
