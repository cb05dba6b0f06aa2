"""`autograder export otter`: the master notebook for `otter assign`."""

from __future__ import annotations

from pathlib import Path

import click


@click.command()
@click.option(
    "--course", "course_file", type=click.Path(path_type=Path), metavar="FILE", help="Settings of the course."
)
@click.option(
    "-o", "--output", "folder", required=True, type=click.Path(path_type=Path), metavar="DIR", help="Folder to write."
)
def command(course_file: Path | None, folder: Path) -> None:
    """Write the master notebook for Otter.

    `otter assign slam1d.ipynb dist` in that folder makes the notebook for students and an autograder.zip. Otter runs
    hidden tests beside the student's code: where marks count, use `autograder grade` on the collected notebooks.

    \b
    autograder export otter -o slam-otter
    cd slam-otter && otter assign slam1d.ipynb dist
    """
    from autograder.commands.export._shared import write_new
    from autograder.course import load_course
    from autograder.exports.otter.master import master_files
    from autograder.problems.problem import worked_problem

    course = load_course(course_file)
    write_new(folder, master_files(course.points, course.stages, worked_problem(), course=course.title))
