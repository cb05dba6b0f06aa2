"""Recognise a known mistake: its outputs equal the student's on every case of the corpus."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from autograder.problems.cases import Case
from autograder.problems.irregular import GOLDEN
from autograder.stages.base import Answers, Array, Slip, Stage
from autograder.stages.catalogue import slips

FIRST = 16  # calls that are compared one by one, before all the rest
CLOSE = 1e-8  # relative to the largest number of the array: rounding is smaller, single precision is larger
COARSE = 1e-6  # the same for answers that were rounded to single precision


def trusted_call(function: Callable[..., Any], call: Case, parts: int) -> tuple[Array, ...] | None:
    """Call a slip on fresh copies; None where it raises or returns no numbers, as a student's code may."""
    arguments = [each.copy() if isinstance(each, np.ndarray) else each for each in call]
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            value = function(*arguments)
            arrays = value if parts > 1 else (value,)
            return tuple(np.asarray(array, dtype=np.float64) for array in arrays)
    except Exception:  # noqa: BLE001 - a slip may raise anything: that is its behaviour
        return None


def same(one: Array, other: Array, close: float = CLOSE) -> bool:
    """Whether two arrays have one shape and the same numbers up to rounding.

    Examples
    --------
    >>> same(np.array([1.0, 2.0]), np.array([1.0, 2.0 + 1e-12])), same(np.zeros(2), np.zeros((2, 1)))
    (True, False)
    """
    if one.shape != other.shape:
        return False
    finite = np.isfinite(other)
    if not np.array_equal(np.isfinite(one), finite):
        return False
    size = np.abs(other[finite]).max(initial=0.0)
    return bool((np.abs(one[finite] - other[finite]) <= close * (size + 1e-6)).all())


@dataclass(frozen=True)
class Given:
    """Answers laid end to end: what came back for several batches, or what a slip returned."""

    outcome: NDArray[np.uint8]
    shapes: list[tuple[int, ...]]
    offsets: NDArray[np.int64]
    data: Array


@dataclass
class Recogniser:
    """Knows the slips of one stage and what each answers on the calls of the corpus.

    Outputs of slips are computed at the first use, call by call, and kept: the work is paid once
    a run, and most slips are told apart from an answer by the first few calls: these are taken
    from all over the corpus, for the simple cases at its beginning hide the most. The rest of the
    calls is compared at once. `same_as` says for each call which earlier one asks the same and
    answers for it.
    """

    stage: Stage
    calls: Sequence[Case]
    same_as: NDArray[np.int64]
    _known: dict[tuple[str, int], tuple[Array, ...] | None] = field(default_factory=dict)
    _whole: dict[str, Given] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._first = sorted(range(len(self.calls)), key=lambda index: (index * GOLDEN) % 1.0)[:FIRST]

    def recognise(self, answers: Answers, close: float = CLOSE) -> Slip | None:
        """Return the slip whose outputs equal the answers on all calls, as closely as they can, or None."""
        given: dict[int, tuple[Array, ...] | None] = {}

        def agrees(slip: Slip, index: int) -> bool:
            if index not in given:
                given[index] = self._given(answers, index)
            return _agree(self._sent(slip, index, answers), given[index], close)

        known = slips(self.stage.name)
        for slip in known:
            if slip.pattern is not None or not all(agrees(slip, index) for index in self._first):
                continue
            if _all_agree(self._outputs(slip, answers), answers, close):
                return slip
        met = [(call, self._given(answers, index)) for index, call in enumerate(self.calls)]
        return next((slip for slip in known if slip.pattern is not None and slip.pattern(met)), None)

    def _given(self, answers: Answers, index: int) -> tuple[Array, ...] | None:
        if answers.outcome[index] != 0:
            return None
        parts = self.stage.parts
        return tuple(
            answers.data[answers.offsets[part] : answers.offsets[part + 1]].reshape(answers.shapes[part])
            for part in range(index * parts, (index + 1) * parts)
        )

    def _output(self, slip: Slip, index: int) -> tuple[Array, ...] | None:
        key = (slip.identifier, int(self.same_as[index]))
        if key not in self._known:
            if slip.remembers:  # called as a submission is: every call, in order
                slip.function.__dict__.clear()
            for number in np.unique(self.same_as).tolist() if slip.remembers else key[1:]:
                answer = trusted_call(slip.function, self.calls[number], self.stage.parts)
                self._known[slip.identifier, number] = answer
        return self._known[key]

    def _outputs(self, slip: Slip, answers: Answers) -> Given:
        """Return all that a slip answers, but for what would not be sent."""
        found = [self._output(slip, index) for index in range(len(self.calls))]
        sent = [self._sent(slip, index, answers) for index in range(len(self.calls))]
        if any(one is not other for one, other in zip(found, sent, strict=True)):
            return laid_out(sent, self.stage.parts)
        if slip.identifier not in self._whole:
            self._whole[slip.identifier] = laid_out(found, self.stage.parts)
        return self._whole[slip.identifier]

    def _sent(self, slip: Slip, index: int, answers: Answers) -> tuple[Array, ...] | None:
        """Return what a slip answers; None where no numbers came, and the slip's are too many to be sent, too.

        A sandbox refuses an array of more than twice the numbers that are expected: a matrix for a step, say.
        """
        found = self._output(slip, index)
        if found is None or answers.outcome[index] == 0:
            return found
        most = 2 * max(math.prod(shape) for shape in self.stage.shapes(*self.calls[index]))
        return None if max(array.size for array in found) > most else found


def laid_out(values: Sequence[tuple[Array, ...] | None], parts: int) -> Given:
    """Lay answers end to end, as they come from a sandbox; where there are no numbers the shape is ()."""
    nothing = (np.zeros(0),) * parts
    arrays = [array for value in values for array in (value or nothing)]
    return Given(
        outcome=np.array([value is None for value in values], dtype=np.uint8),
        shapes=[shape for value in values for shape in ([()] * parts if value is None else [a.shape for a in value])],
        offsets=np.cumsum([0, *(array.size for array in arrays)]),
        data=np.concatenate([array.ravel() for array in arrays]),
    )


def _agree(expected: tuple[Array, ...] | None, given: tuple[Array, ...] | None, close: float) -> bool:
    if expected is None or given is None:
        return expected is given
    return len(expected) == len(given) and all(
        same(one, other, close) for one, other in zip(given, expected, strict=True)
    )


def _all_agree(expected: Given, given: Answers, close: float) -> bool:
    """Whether `same` holds for all arrays of two answers, and both have no numbers in the same calls."""
    if not np.array_equal(expected.outcome != 0, given.outcome != 0) or expected.shapes != given.shapes:
        return False
    finite = np.isfinite(expected.data)
    if not np.array_equal(finite, np.isfinite(given.data)):
        return False
    sizes = np.diff(expected.offsets)
    starts = expected.offsets[:-1][sizes > 0]
    wanted, got = np.where(finite, expected.data, 0.0), np.where(finite, given.data, 0.0)
    largest = np.repeat(np.maximum.reduceat(np.abs(wanted), starts), sizes[sizes > 0]) if len(starts) else wanted
    return bool((np.abs(got - wanted) <= close * (largest + 1e-6)).all())
