"""`autograder init`: a commented course.toml to edit."""

from __future__ import annotations

from pathlib import Path

import click


@click.command()
@click.argument("course", type=click.Path(path_type=Path), default=Path("course.toml"))
def command(course: Path) -> None:
    """Write a commented course file: points, stages, limits, feedback.

    Every setting in it is the default, so it changes nothing until you edit it. COURSE is the file
    to write, course.toml where none is named; a file that is there already is left alone.

    \b
    autograder init                      writes course.toml here
    autograder init slam/course.toml     writes it there
    autograder grade uploads/ --course course.toml -o graded
    """
    from autograder.course import write_course

    write_course(course)
    click.echo(f"Wrote {course}. Edit it, then: autograder grade UPLOADS --course {course} -o OUT")
