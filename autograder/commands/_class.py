"""Who is in the class and which numbers each of them has, for the commands that deal with variants."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

if TYPE_CHECKING:
    from collections.abc import Mapping

    from autograder.course import Course
    from autograder.problems.discriminating import Demand, Mistake
    from autograder.problems.ledger import Ledger
    from autograder.problems.roster import Student
    from autograder.problems.secret import Secret
    from autograder.render.grading import Grading

Function = TypeVar("Function", bound=Callable[..., Any])
Draws = Callable[[int, int, str], None]

FAMILY_HELP = (
    "Family of the variants by letter or name, with options after a colon (A, interior-loop, B:poses=7); "
    "given again, a mix. [default: the course's, or A]"
)


def secret_options(required: bool) -> Callable[[Function], Function]:
    """Add what variants are drawn from: term, secret, families."""

    def add(function: Function) -> Function:
        for option in (
            click.option("--family", "families", multiple=True, metavar="NAME", help=FAMILY_HELP),
            click.option(
                "--secret-file",
                type=click.Path(path_type=Path),
                required=required,
                metavar="F",
                help="File with the secret of the course.",
            ),
            click.option("--term", required=required, metavar="NAME", help="Name of the term, such as 2026S."),
        ):
            function = option(function)
        return function

    return add


def mix_of(families: Sequence[str], course: Course) -> dict[str, int]:
    """Count the families of the command line, else those of the course file."""
    from autograder.problems.drawing import checked_mix

    return checked_mix(Counter(families or course.families))


def grading_of(course: Course) -> Grading:
    """Take from a course what its students are told before they hand in; a title that nobody chose stays ours."""
    from autograder.course import Course
    from autograder.marking.clock import clock
    from autograder.marking.merging import WRITTEN, question_maxima
    from autograder.render.grading import Grading

    named = {} if course.title == Course().title else {"title": course.title}
    return Grading(
        points={name: course.points[name] for name in course.stages},
        questions=question_maxima(course, course.points[WRITTEN]),
        follow_through=course.follow_through,
        due="" if course.due is None else clock(course.due, course.zone),
        **named,
    )


def secret_of(term: str | None, secret_file: Path | None) -> Secret | None:
    """Read the secret where term and file are given; one without the other is an error."""
    from autograder.errors import UsageError
    from autograder.problems.secret import read_secret

    if (term is None) != (secret_file is None):
        missing = "--secret-file" if secret_file is None else "--term"
        raise UsageError(f"--term and --secret-file go together: {missing} is missing.")
    if term is not None and not term.strip():
        raise UsageError("--term is empty; expected the name of a term, such as 2026S.")
    return None if secret_file is None else read_secret(secret_file)


def known_mistakes() -> dict[str, Mistake]:
    """Put every catalogued slip of a function among right functions: what a variant has to show."""
    from autograder.problems.discriminating import mistaken
    from autograder.render.facts import reference
    from autograder.stages.catalogue import slips

    names = ("residual", "jacobian", "information_matrix", "normal_equations")
    right = {name: getattr(reference(), name) for name in names}
    return {
        f"{stage}.{slip.identifier}": mistaken(right, stage, slip.function)
        for stage in (*names, "gauss_newton_step")
        for slip in slips(stage)
    }


def demand_of(mix: Mapping[str, int]) -> Demand:
    """Find out what the families of a mix can show."""
    return _demand(tuple(sorted(mix)))


@cache
def _demand(labels: tuple[str, ...]) -> Demand:
    from autograder.problems.discriminating import Demand
    from autograder.problems.families import family

    return Demand([family(label) for label in labels], known_mistakes())


def drawn_ledger(
    students: Sequence[Student], secret: Secret, term: str, mix: Mapping[str, int], on_draw: Draws | None = None
) -> Ledger:
    """Draw the variants of a class as a first release of it would: the same ones."""
    from autograder.problems.drawing import draw_class
    from autograder.problems.ledger import Ledger

    ledger = Ledger()
    ids = [student.student_id for student in students]
    draw_class(ledger, ids, secret, term, mix, accept=demand_of(mix).accept, on_draw=on_draw)
    return ledger
