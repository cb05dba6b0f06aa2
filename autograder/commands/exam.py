"""`autograder exam`: draw the exam of a class into a file, or say what a file holds."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from autograder.engine.exam import Exam


@click.command()
@click.argument("file", required=False, type=click.Path(path_type=Path), metavar="[FILE]")
@click.option("-o", "--output", "out", type=click.Path(path_type=Path), metavar="FILE", help="Draw, and write it here.")
@click.option(
    "--course",
    "course_file",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Settings of the course (see: autograder init).",
)
@click.option(
    "--seed", type=click.IntRange(0), metavar="S", help="Which cases are drawn. [default: the course's, or 0]"
)
@click.option("--examples", type=click.IntRange(1), metavar="N", help="Cases a stage. [default: the course's, or 200]")
def command(
    file: Path | None, out: Path | None, course_file: Path | None, seed: int | None, examples: int | None
) -> None:
    """Draw an exam into a file, or say what one holds.

    Everybody who is graded with one file sits the same exam, whatever versions are installed and
    whenever it is; a seed promises that for one version of Hypothesis only. `grade` keeps the exam
    of its results as OUT/exam and takes it again, so this is for exams that are shared.

    \b
    autograder exam -o midterm.exam --seed 2026
    autograder exam midterm.exam
    autograder grade uploads/ -o graded --exam midterm.exam
    """
    from autograder.engine.exam import draw_exam, read_exam, save_exam
    from autograder.errors import UsageError

    if (file is None) == (out is None):
        raise UsageError("Expected one of two: -o FILE to draw an exam into, or FILE to say what it holds.")
    if file is not None:
        if course_file is not None or seed is not None or examples is not None:
            raise UsageError(f"--course, --seed and --examples say what is drawn, and {file} is drawn already.")
        click.echo(described(read_exam(file)))
        return
    assert out is not None
    from autograder.course import load_course

    course = load_course(course_file)
    drawn = draw_exam(seed if seed is not None else (course.seed or 0), examples or course.examples)
    save_exam(drawn, out)
    click.echo(described(drawn))
    click.echo(f"\nWrote {out}. Grade with it: autograder grade uploads/ -o graded --exam {out}", err=True)


def described(exam: Exam) -> str:
    """Say in a few lines what an exam holds."""
    from autograder.engine.exam import sizes

    counts = sizes(exam)
    width = max(map(len, counts))
    with_what = ", ".join(f"{name} {version}" for name, version in exam.drawn_with.items())
    return "\n".join(
        [
            f"exam of {exam.homework}, seed {exam.seed}, {exam.examples} cases drawn a stage beside the fixed core",
            *(f"  {name:<{width}}  {count:4} cases" for name, count in counts.items()),
            f"drawn with {with_what}",
            f"SHA-256 {exam.digest}",
        ]
    )
