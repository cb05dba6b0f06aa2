"""Somebody else's numbers in a submission: what personal variants make visible, for staff only.

They show copied numbers. They do not show copied code: code that is right is right for everybody.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import islice

import numpy as np

from autograder.problems.variants import Variant, published

__all__ = ["Carried", "Numbers"]

FINE = 10**4  # answers are compared in tenths of a millimetre
MOST_NUMBERS = 20_000  # of one source; a submission of this homework has a few dozen
_LITERAL = re.compile(r"(?<![\w.])-?\d+(?:\.\d*)?(?:[eE][+-]?\d+)?(?![\w.])")


@dataclass(frozen=True)
class Carried:
    """Numbers in a submission that belong to other students.

    Parameters
    ----------
    owners : tuple of str
        Ids of those whose numbers they are.
    where : str
        "the answer x^(1)", "the start x^(0)" or "the measurements in the source".
    """

    owners: tuple[str, ...]
    where: str

    def text(self) -> str:
        """Say it in a sentence."""
        return f"{self.where[0].upper()}{self.where[1:]}: the numbers of {', '.join(self.owners)}."


class Numbers:
    """The numbers of a whole class, to be recognised in a submission.

    The worked example is nobody's own and is never recognised.

    Parameters
    ----------
    variants : iterable of Variant
        The ledger.
    """

    def __init__(self, variants: Iterable[Variant]) -> None:
        self._answers: defaultdict[tuple[int, ...], list[str]] = defaultdict(list)
        self._starts: defaultdict[tuple[int, ...], list[str]] = defaultdict(list)
        self._data: defaultdict[tuple[int, ...], list[str]] = defaultdict(list)
        for variant in variants:
            if variant.fingerprint != published().fingerprint:
                self._answers[_fine(variant.x1)].append(variant.student_id)
                self._starts[_fine(variant.x0)].append(variant.student_id)
                self._data[_fine(variant.exact.measurements)].append(variant.student_id)

    def in_answers(self, student_id: str | None, iterates: Sequence[Sequence[float]] | np.ndarray) -> list[Carried]:
        """Look for somebody else's answer or start among the iterates that a student reports.

        Numbers that are also the student's own are never counted.
        """
        found: dict[tuple[tuple[str, ...], str], None] = {}
        for row in np.asarray(iterates, dtype=np.float64):
            if not np.isfinite(row).all() or np.abs(row).max(initial=0.0) > 1e6:
                continue
            key = tuple(int(value) for value in np.rint(row * FINE))
            for where, known in (("the answer x^(1)", self._answers), ("the start x^(0)", self._starts)):
                owners = known.get(key, [])
                if owners and student_id not in owners:
                    found[tuple(owners), where] = None
        return [Carried(owners, where) for owners, where in found]

    def in_text(self, student_id: str | None, text: str) -> list[Carried]:
        """Look for somebody else's measurements among the numbers that stand in a source, in their order."""
        numbers = [_literal(word[0]) for word in islice(_LITERAL.finditer(text), MOST_NUMBERS)]
        lengths = sorted({len(key) for key in self._data})
        found: dict[tuple[str, ...], None] = {}
        for length in lengths:
            for first in range(len(numbers) - length + 1):
                owners = self._data.get(tuple(numbers[first : first + length]), [])
                if owners and student_id not in owners:
                    found[tuple(owners)] = None
        return [Carried(owners, "the measurements in the source") for owners in found]


def _fine(values: Iterable[Fraction]) -> tuple[int, ...]:
    return tuple(round(value * FINE) for value in values)


def _literal(word: str) -> int:
    """Read a number literal on the grid; one that no variant can hold becomes a number that none holds."""
    value = float(word) * FINE
    return round(value) if abs(value) < 1e12 else 10**13
