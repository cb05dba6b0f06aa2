"""`autograder audit`: the grader grades itself, and says whether the exam is sharp."""

from __future__ import annotations

from pathlib import Path

import click


@click.command()
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
@click.option("--examples", type=click.IntRange(0), metavar="N", help="Cases a stage. [default: the course's, or 200]")
@click.option("--verbose", is_flag=True, help="Print every row, not only the wrong ones.")
@click.option("--json", "as_json", is_flag=True, help="One object to stdout, and no table.")
def command(course_file: Path | None, seed: int | None, examples: int | None, verbose: bool, as_json: bool) -> int:
    """Grade everything whose verdict is known, and compare.

    The reference, the unfinished stub, correct answers in many styles, known mistakes and hostile
    submissions go through the grader as a class does. Run it after you have changed points,
    stages or tolerances: it says whether the exam still catches what it should. What is wrong is explained, and
    tried again, alone and with the defaults, to say whether a setting, the machine or the grader is to blame.

    \b
    autograder audit
    autograder audit --course course.toml --examples 50
    autograder audit --json | jq .clean

    Exit code: 0 every verdict is right, 1 one is wrong, or a check catches nothing.
    """
    import json

    from autograder.audit import audit
    from autograder.audit.table import text
    from autograder.commands._class import mix_of
    from autograder.commands._progress import progress
    from autograder.course import load_course
    from autograder.engine.grade import Progress

    course = load_course(course_file)
    mix_of((), course)  # a family that does not exist is better known now than at the release
    with progress() as report:
        found = audit(
            course,
            seed if seed is not None else (course.seed or 0),
            course.examples if examples is None else examples,
            lambda done, total, name: report(Progress(done, total, 0, name)),
        )
    click.echo(json.dumps(found.plain()) if as_json else text(found, verbose=verbose))
    return 0 if found.clean else 1
