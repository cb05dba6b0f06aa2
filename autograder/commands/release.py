"""`autograder release`: a personal assignment folder for every student, and the keys for staff."""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

import click

from autograder.commands._class import secret_options

if TYPE_CHECKING:
    from autograder.problems.problem import Problem


@click.command()
@click.option(
    "--roster",
    required=True,
    type=click.Path(path_type=Path),
    metavar="CSV",
    help="The class: a column student_id, and name and email if wanted.",
)
@secret_options(required=True)
@click.option(
    "-o",
    "--output",
    "out",
    required=True,
    type=click.Path(path_type=Path),
    metavar="DIR",
    help="Folder of the release; a second run into it adds what is new.",
)
@click.option(
    "--course", "course_file", type=click.Path(path_type=Path), metavar="FILE", help="Settings of the course."
)
@click.option("--workers", type=click.IntRange(1), metavar="N", help="Processes at a time. [default: all cores]")
@click.option("--force", is_flag=True, help="Render folders again that have changed; accept another secret or term.")
def command(
    roster: Path,
    term: str,
    secret_file: Path,
    families: Sequence[str],
    out: Path,
    course_file: Path | None,
    workers: int | None,
    force: bool,
) -> None:
    """Give every student of a class a problem with numbers of their own.

    Writes DIR/students/ID/ and DIR/zips/ID.zip to hand out, and DIR/staff/ to keep: variants.csv, which
    grading reads, keys.csv, and the worked solution of every student. Nothing of staff/ is in a student's
    folder. The same roster, term and secret give the same numbers; running it again changes nothing.

    \b
    python3 -c 'import secrets; print(secrets.token_hex(32))' > secret.txt
    autograder release --roster class.csv --term 2026S --secret-file secret.txt -o release
    autograder release --roster class.csv --term 2026S --secret-file secret.txt --family B --family C -o release
    """
    from autograder.commands._class import demand_of, mix_of, secret_of
    from autograder.commands._progress import shown
    from autograder.course import load_course
    from autograder.engine.local import default_workers
    from autograder.problems.release import LEDGER, release
    from autograder.problems.roster import read_roster
    from autograder.render.handout import render_folder

    mix = mix_of(families, load_course(course_file))
    students = read_roster(roster)
    secret = secret_of(term, secret_file)
    assert secret is not None  # both options are required
    demand = demand_of(mix)
    with ExitStack() as stack:
        done = release(
            students,
            secret,
            term,
            mix,
            out,
            render=render_folder,
            render_key=worked_solution,
            accept=demand.accept,
            notes={"mistakes.txt": demand.text()},
            force=force,
            workers=workers or default_workers(),
            on_draw=shown(stack, "drawing", "drew"),
            on_progress=shown(stack, "writing", "wrote"),
        )
    click.echo(done.text())
    click.echo(
        f"\nTo hand out: {out / 'zips'}, or {out / 'students'}. For staff: {out / 'staff'}; keep variants.csv safe.\n"
        f"When they hand in: {_grading(roster, term, secret_file, families, out / LEDGER, course_file)}"
    )


def _grading(roster: Path, term: str, secret: Path, families: Sequence[str], ledger: Path, course: Path | None) -> str:
    """Return the whole command that grades what is handed in, to be pasted into a shell."""
    parts: list[tuple[str, object]] = [("--roster", roster), ("--term", term), ("--secret-file", secret)]
    parts += [("--family", name) for name in families]
    parts += [("--ledger", ledger)] + ([("--course", course)] if course is not None else [])
    words = [word for option, value in parts for word in (option, str(value))]
    return f"autograder grade UPLOADS {shlex.join(words)} -o graded"


def worked_solution(problem: Problem) -> dict[str, str]:
    """Render what staff mark with: the page with model answers, also to print, and the notebook, not executed."""
    from autograder.render.solution import render_solution

    rendered = render_solution(problem)
    return {".md": rendered["SOLUTION.md"], ".html": rendered["SOLUTION.html"], ".ipynb": rendered["slam1d.ipynb"]}
