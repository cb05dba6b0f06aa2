"""Short oral questions on a student's own numbers, with answers: for a talk of five minutes."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from autograder.problems.exact import decimal
from autograder.problems.loops import solve_by_loops
from autograder.problems.variants import Variant

__all__ = ["Question", "viva", "viva_text"]


class Question(NamedTuple):
    """One question with its answer."""

    question: str
    answer: str


def viva(variant: Variant, count: int = 3) -> list[Question]:
    """Choose questions for a variant: the same ones whenever it is asked for.

    Parameters
    ----------
    variant : Variant
        Whose numbers the questions are about.
    count : int
        How many.
    """
    left = list(_QUESTIONS)
    number = int(variant.fingerprint, 16)
    chosen = []
    for _ in range(min(count, len(left))):
        number, place = divmod(number, len(left))
        chosen.append(left.pop(place)(variant))
    return chosen


def viva_text(variant: Variant, count: int = 3) -> str:
    """Write the questions of a variant, each with its answer below."""
    asked = enumerate(viva(variant, count), 1)
    return "\n\n".join(f"{number}. {question}\n   Answer: {answer}" for number, (question, answer) in asked)


def _mismatch(variant: Variant) -> Question:
    graph = variant.exact
    (i, j), z = graph.edges[-1], graph.measurements[-1]
    says = variant.x0[j] - variant.x0[i]
    return Question(
        f"Your loop closure {i} → {j} measured {decimal(z)} m. What does dead reckoning say of x{j} − x{i}, "
        "and what is that row of f at the start?",
        f"Dead reckoning says {decimal(says)} m; the row of f is measured minus that, {decimal(z - says)} m.",
    )


def _information(variant: Variant) -> Question:
    graph = variant.exact
    (i, j), v = graph.edges[-1], graph.edge_variances[-1]
    return Question(
        f"Suppose the variance of your loop closure {i} → {j} were {decimal(v / 2)} m² instead of {decimal(v)} m². "
        "Which entries of H change, and by how much?",
        f"Its information goes from {decimal(1 / v)} to {decimal(2 / v)}: H[{i},{i}] and H[{j},{j}] grow by "
        f"{decimal(1 / v)}, H[{i},{j}] and H[{j},{i}] fall by {decimal(1 / v)}; nothing else changes.",
    )


def _largest(variant: Variant) -> Question:
    solved = solve_by_loops(variant.exact)
    sizes = [abs(value) for value in solved.corrections]
    edges = [f"{i} → {j}" for (i, j), size in zip(variant.exact.edges, sizes, strict=True) if size == max(sizes)]
    return Question(
        "Which of your measurements is changed most by the step, and why this one?",
        f"{' and '.join(edges)}, by {decimal(max(sizes))} m: an edge gives way by its variance times the forces of "
        "the loops that it lies on.",
    )


def _other_start(variant: Variant) -> Question:
    return Question(
        "You start from x = 0 everywhere instead of dead reckoning. Where are you after one step, and what is the "
        "second step?",
        f"At the same x^(1), with x{len(variant.x1) - 1} = {decimal(variant.x1[-1])}; the second step is 0, because J "
        "does not depend on x.",
    )


def _prior(variant: Variant) -> Question:
    k, mean = variant.exact.priors[0], variant.exact.prior_means[0]
    return Question(
        "The variance of your prior becomes ten times larger. What happens to the step, and what would happen "
        "without the prior?",
        f"Nothing: x{k} stays at {decimal(mean)}, because nothing else says where the chain lies. Without it H is "
        "singular: all poses may move together.",
    )


def _row(variant: Variant) -> Question:
    row = len(variant.exact.edges) - 1
    i, j = variant.exact.edges[row]
    return Question(
        f"What stands in row {row} of your J, and what in row {row + 1}?",
        f"Row {row} is the loop closure: +1 in column {i}, −1 in column {j}. Row {row + 1} is the prior: +1 in column "
        f"{variant.exact.priors[0]}.",
    )


def _left_over(variant: Variant) -> Question:
    i, j = variant.exact.edges[-1]
    left = variant.exact.residual(variant.x1)[len(variant.exact.edges) - 1]
    return Question(
        f"After the step, is the row of f of your loop closure {i} → {j} zero? What does its value mean?",
        f"No, it is {decimal(left)} m: odometry and loop closure still disagree, and each gives way by its share.",
    )


_QUESTIONS: tuple[Callable[[Variant], Question], ...] = (
    _mismatch,
    _information,
    _largest,
    _other_start,
    _prior,
    _row,
    _left_over,
)
