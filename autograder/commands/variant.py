"""`autograder variant`: one student's numbers on the terminal, with what staff need for a talk."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from autograder.commands._class import secret_options

if TYPE_CHECKING:
    from autograder.problems.ledger import Ledger
    from autograder.problems.variants import Variant


@click.command()
@click.argument("student_id", metavar="STUDENT")
@click.option(
    "--ledger",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="variants.csv of the release: what was handed out.",
)
@click.option(
    "--roster", type=click.Path(path_type=Path), metavar="CSV", help="The class, to draw the variant again with it."
)
@secret_options(required=False)
@click.option(
    "--course", "course_file", type=click.Path(path_type=Path), metavar="FILE", help="Settings of the course."
)
@click.option("--no-answers", is_flag=True, help="Show only what the student was given.")
@click.option("--by-hand", is_flag=True, help="Show the solution by hand, in whole numbers, as Markdown.")
@click.option("--viva", is_flag=True, help="Show three short oral questions with their answers.")
def command(
    student_id: str,
    ledger: Path | None,
    roster: Path | None,
    term: str | None,
    secret_file: Path | None,
    families: Sequence[str],
    course_file: Path | None,
    no_answers: bool,
    by_hand: bool,
    viva: bool,
) -> None:
    """Show the variant of one student: picture, data, and the solution for staff.

    The ledger of the release says what was handed out. Without it the variant is drawn again from
    roster, term and secret, as a first release of that roster would.

    \b
    autograder variant s1001 --ledger release/staff/variants.csv
    autograder variant s1001 --ledger release/staff/variants.csv --viva
    autograder variant s1001 --roster class.csv --term 2026S --secret-file secret.txt
    """
    from autograder.commands._class import drawn_ledger, mix_of, secret_of
    from autograder.course import load_course
    from autograder.errors import UsageError
    from autograder.problems.hand_solution import hand_solution
    from autograder.problems.ledger import read_ledger
    from autograder.problems.listing import describe
    from autograder.problems.roster import read_roster
    from autograder.problems.viva import viva_text

    secret = secret_of(term, secret_file)
    if ledger is not None:
        variant = _found(student_id, read_ledger(ledger), f"The ledger {ledger}")
    elif roster is not None and secret is not None and term is not None:
        mix = mix_of(families, load_course(course_file))
        variant = _found(student_id, drawn_ledger(read_roster(roster), secret, term, mix), f"The roster {roster}")
    else:
        raise UsageError("Whose numbers? Give --ledger FILE, or --roster CSV with --term NAME and --secret-file F.")
    click.echo(describe(variant, picture=_picture(variant), answers=not no_answers))
    if by_hand:
        click.echo("\n" + hand_solution(variant), nl=False)
    if viva:
        click.echo("\n" + viva_text(variant))


def _found(student_id: str, entries: Ledger, source: str) -> Variant:
    import difflib

    from autograder.errors import UsageError

    variant = entries.get(student_id)
    if variant is None:
        near = difflib.get_close_matches(student_id, [each.student_id for each in entries], 1)
        guess = f"; did you mean {near[0]}?" if near else "."
        raise UsageError(f"{source} has no student {student_id!r} among its {len(entries)}{guess}")
    return variant


def _picture(variant: Variant) -> str:
    from autograder.reports.picture import picture

    graph = variant.graph
    return picture(
        {
            "n_poses": graph.n_poses,
            "edges": graph.edges.tolist(),
            "measurements": graph.measurements.tolist(),
            "priors": graph.priors.tolist(),
            "prior_means": graph.prior_means.tolist(),
        }
    )
