"""`autograder release`: a personal assignment folder for every student, and the keys for staff."""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from contextlib import ExitStack
from datetime import UTC, datetime
from functools import partial
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
@click.option(
    "--solutions", is_flag=True, help="After the due date: write DIR/solutions/ID.html, model answers on own numbers."
)
@click.option("--force", is_flag=True, help="Render folders again that have changed; accept another secret or term.")
def command(
    roster: Path,
    term: str,
    secret_file: Path,
    families: Sequence[str],
    out: Path,
    course_file: Path | None,
    workers: int | None,
    solutions: bool,
    force: bool,
) -> None:
    """Give every student of a class a problem with numbers of their own.

    Writes DIR/students/ID/ and DIR/zips/ID.zip to hand out, and DIR/staff/ to keep: variants.csv, which
    grading reads, keys.csv, mail.csv for mail merge, the exam that all graders share, and the worked solution of
    every student. Nothing of staff/ is in a student's folder. The same roster, term and secret give the same
    numbers; running it again changes nothing. With --course, handout and notebook tell the course's title, points,
    share and due date.

    \b
    python3 -c 'import secrets; print(secrets.token_hex(32))' > secret.txt
    autograder release --roster class.csv --term 2026S --secret-file secret.txt -o release
    autograder release --roster class.csv --term 2026S --secret-file secret.txt --family B --family C -o release
    """
    from autograder.commands._class import demand_of, grading_of, mix_of, secret_of
    from autograder.commands._exam import shared_exam
    from autograder.commands._progress import shown
    from autograder.commands._solutions import FOLDER, check_time, release_solutions
    from autograder.course import load_course
    from autograder.engine.local import default_workers
    from autograder.exports.handout import mail_table
    from autograder.problems.ledger import read_ledger
    from autograder.problems.release import EXAM, LEDGER, release
    from autograder.problems.roster import read_roster
    from autograder.render.handout import render_folder

    course = load_course(course_file)
    if solutions:
        check_time(course, datetime.now(UTC))
    grading = grading_of(course)
    mix = mix_of(families, course)
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
            render=partial(render_folder, grading=grading),
            render_key=worked_solution,
            accept=demand.accept,
            notes={"mistakes.txt": demand.text(), "mail.csv": mail_table(students, grading.title, grading.due)},
            force=force,
            workers=workers or default_workers(),
            on_draw=shown(stack, "drawing", "drew"),
            on_progress=shown(stack, "writing", "wrote"),
        )
    if solutions:
        count = release_solutions(read_ledger(out / LEDGER), out)
        click.echo(f"To hand out now: {out / FOLDER}, model answers for {count} students.")
    exam = out / EXAM
    seed = secret.seed(term) if course.seed is None else course.seed
    note = shared_exam(exam, seed, course.examples, force=force)
    click.echo("\n".join(filter(None, [done.text(), note])))
    click.echo(
        f"\nTo hand out: {out / 'zips'}, or {out / 'students'}. To mail: {out / 'staff' / 'mail.csv'}; "
        "for Moodle and Canvas: `autograder export handout`.\n"
        f"For staff: {out / 'staff'}; keep variants.csv safe.\n"
        f"When they hand in: {_grading(roster, term, secret_file, families, out / LEDGER, course_file, exam)}"
    )


def _grading(
    roster: Path, term: str, secret: Path, families: Sequence[str], ledger: Path, course: Path | None, exam: Path
) -> str:
    """Return the whole command that grades what is handed in, to be pasted into a shell."""
    parts: list[tuple[str, object]] = [("--roster", roster), ("--term", term), ("--secret-file", secret)]
    parts += [("--family", name) for name in families]
    parts += [("--ledger", ledger)] + ([("--course", course)] if course is not None else [])
    parts.append(("--exam", exam))
    words = [word for option, value in parts for word in (option, str(value))]
    return f"autograder grade UPLOADS {shlex.join(words)} -o graded"


def worked_solution(problem: Problem) -> dict[str, str]:
    """Render what staff mark with: the page with model answers, also to print, and the notebook, not executed."""
    from autograder.render.solution import render_solution

    rendered = render_solution(problem)
    return {".md": rendered["SOLUTION.md"], ".html": rendered["SOLUTION.html"], ".ipynb": rendered["slam1d.ipynb"]}
