"""`autograder export nbgrader`: a course folder whose notebook nbgrader can mark, or feedback for an existing one."""

from __future__ import annotations

from pathlib import Path

import click


@click.command()
@click.option(
    "--course", "course_file", type=click.Path(path_type=Path), metavar="FILE", help="Settings of the course."
)
@click.option("--assignment", default="slam1d", metavar="NAME", show_default=True, help="Name of the assignment.")
@click.option(
    "--feedback-of",
    "out",
    type=click.Path(path_type=Path),
    metavar="OUT",
    help="Write the pages of this run into the feedback tree instead.",
)
@click.option(
    "-o", "--output", "folder", required=True, type=click.Path(path_type=Path), metavar="DIR", help="Course folder."
)
def command(course_file: Path | None, assignment: str, out: Path | None, folder: Path) -> None:
    """Write a course folder for nbgrader.

    It holds the source notebook with solutions, tests that students can read, hidden tests, and written answers to
    mark by hand, with the points of the course file. nbgrader runs hidden tests beside the student's code: where
    marks count, use `autograder grade` on the folder `submitted`, and give the feedback back with --feedback-of.

    \b
    autograder export nbgrader -o slam-course
    autograder grade slam-course/submitted -o graded
    autograder export nbgrader --feedback-of graded -o slam-course
    """
    from autograder.commands.export._shared import say, stored, write_new, write_tree
    from autograder.course import load_course
    from autograder.errors import UsageError
    from autograder.exports.nbgrader.course import course_files
    from autograder.exports.nbgrader.feedback import feedback_tree
    from autograder.problems.problem import worked_problem

    if not assignment or set(assignment) & set("+/\\") or assignment.startswith("."):
        raise UsageError(f"--assignment {assignment!r}: nbgrader takes no name with + or /; choose another.")
    if out is None:
        course = load_course(course_file)
        files = course_files(course.points, course.stages, worked_problem(), assignment=assignment, course=course.title)
        write_new(folder, files)
    else:
        run = stored(out, course_file, None)
        write_tree(folder, feedback_tree(run.results, run.pages(), assignment))
        say([], [folder / "feedback"])
