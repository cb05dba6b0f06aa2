"""Variants: one student's own numbers, the same whenever and wherever they are drawn.

A variant is a function of the secret, the term, the student's id and the family. Only where the
numbers are already taken by somebody else does the stream go on to the next ones; that is why the
ledger, and not a second draw, is what grading reads.
"""

from __future__ import annotations

import hashlib
import json
from collections import Counter
from collections.abc import Callable, Mapping, Set
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, cached_property

import numpy as np

from assignment.posegraph import PoseGraph
from autograder.problems.conclusion import Choice, choices
from autograder.problems.exact import ExactGraph, decimal, floats
from autograder.problems.families import family as family_of
from autograder.problems.families.worked_example import worked_example
from autograder.problems.family import Family
from autograder.problems.problem import Problem
from autograder.problems.secret import Secret

__all__ = ["Variant", "choose_family", "draw_variant"]

ITERATES = 4
MOST_REDRAWS = 10_000


@dataclass(frozen=True)
class Variant:
    """One student's problem with everything that follows from it.

    Parameters
    ----------
    family : str
        Label of the family: its letter, and its options where some are set.
    student_id : str
        Whose it is.
    exact : ExactGraph
        The data in fractions.
    x1 : tuple of Fraction
        The least-squares state: every iterate but the first [m].
    truth : tuple of Fraction
        Where the robot really was [m].
    landmarks : tuple of int
        Unknowns that are landmarks.
    """

    family: str
    student_id: str
    exact: ExactGraph
    x1: tuple[Fraction, ...]
    truth: tuple[Fraction, ...]
    landmarks: tuple[int, ...] = ()

    @cached_property
    def graph(self) -> PoseGraph:
        """The problem as a student's functions see it."""
        return self.exact.posegraph()

    @cached_property
    def x0(self) -> tuple[Fraction, ...]:
        """The state to start from, dead reckoning, in fractions [m]."""
        return self.exact.dead_reckoning()

    @property
    def start(self) -> np.ndarray:
        """The state to start from [m], shape (n,)."""
        return floats(self.x0)

    @property
    def step(self) -> tuple[Fraction, ...]:
        """The first step dx, in fractions [m]."""
        return tuple(after - before for after, before in zip(self.x1, self.x0, strict=True))

    @property
    def iterates(self) -> np.ndarray:
        """The states x^(0) to x^(3) [m], shape (4, n): the last three are the same."""
        return np.stack([self.start, *[floats(self.x1)] * (ITERATES - 1)])

    @cached_property
    def fingerprint(self) -> str:
        """16 hexadecimal digits that tell these data from all others; the student's id does not count."""
        return hashlib.sha256(json.dumps(data_fields(self.exact), separators=(",", ":")).encode()).hexdigest()[:16]

    @property
    def identifier(self) -> str:
        """Name of the variant in results: letter and fingerprint, or "worked-example"."""
        if self.fingerprint == published().fingerprint:
            return "worked-example"
        return f"{self.family.partition(':')[0]}-{self.fingerprint}"

    @property
    def choices(self) -> list[Choice]:
        """The choices of question 3 in this variant's order."""
        return choices(self.identifier)

    @property
    def problem(self) -> Problem:
        """What the student's files are rendered from."""
        return Problem(self.identifier, self.graph, self.start, floats(self.truth), self.landmarks)

    @cached_property
    def marks(self) -> frozenset[str]:
        """What must be nobody else's: the data, and the answer.

        The step is not among them: it depends on the mismatch and the variances alone and repeats.
        """
        return frozenset({f"data {self.fingerprint}", "x1 " + " ".join(map(decimal, self.x1))})


def draw_variant(
    secret: Secret,
    term: str,
    student_id: str,
    family: Family,
    *,
    taken: Set[str] = frozenset(),
    accept: Callable[[Variant], bool] | None = None,
    tally: Counter[str] | None = None,
) -> Variant:
    """Draw the variant of one student.

    Parameters
    ----------
    secret : Secret
        Key of the stream.
    term, student_id : str
        What it is drawn for.
    family : Family
        What kind of problem.
    taken : set of str
        The `marks` of the variants of everybody else; those of the worked example are always taken.
    accept : callable, optional
        A further demand, such as that every known mistake shows.
    tally : Counter, optional
        Counts "collision" and "not accepted" draws.

    Raises
    ------
    ValueError
        Where no draw is accepted.
    """
    stream = secret.stream("variant", term, student_id, family.label)
    for _ in range(MOST_REDRAWS):
        draw = family.draw(stream)
        variant = Variant(family.label, student_id, draw.graph, draw.x1, draw.truth, family.landmarks)
        if not family.personal:
            return variant
        if variant.marks & taken or variant.marks & published().marks:
            reason = "collision"
        elif accept is not None and not accept(variant):
            reason = "not accepted"
        else:
            return variant
        if tally is not None:
            tally[reason] += 1
    raise ValueError(f"family {family.label} must have a free variant, got none in {MOST_REDRAWS} draws")


@cache
def published() -> Variant:
    """Return the worked example: its numbers are printed everywhere, so they are nobody's own."""
    exact = ExactGraph.of(worked_example())
    return Variant("E", "", exact, exact.solution(), exact.solution())


def choose_family(secret: Secret, term: str, student_id: str, mix: Mapping[str, int]) -> Family:
    """Draw a student's family from a mix: label -> weight.

    Raises
    ------
    UsageError
        Where a label names no family.

    Examples
    --------
    >>> choose_family(Secret(b"0123456789abcdef"), "2026", "s1001", {"A": 1, "B": 0}).name
    'unequal-variances'
    """
    labels = sorted((family_of(text).label, weight) for text, weight in mix.items())
    place = secret.stream("family", term, student_id).below(sum(weight for _, weight in labels))
    for label, weight in labels:
        if place < weight:
            return family_of(label)
        place -= weight
    raise AssertionError("a place below the sum of the weights lies in one of them")


def data_fields(graph: ExactGraph) -> dict[str, object]:
    """Write the data of a problem as plain JSON values, numbers as text so that they stay exact."""
    return {
        "n": graph.n_poses,
        "edges": [list(edge) for edge in graph.edges],
        "u": [decimal(value) for value in graph.measurements],
        "v": [decimal(value) for value in graph.edge_variances],
        "priors": list(graph.priors),
        "means": [decimal(value) for value in graph.prior_means],
        "prior_v": [decimal(value) for value in graph.prior_variances],
    }
