"""What every stage has: its checks, its expected values, and a verdict for a whole batch at once.

A stage never sees a student's objects. It is given `Answers`: flat float64 numbers with a table of
shapes, rebuilt by the grader from bytes.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from autograder.problems.cases import Case
from autograder.problems.ladders import Ladder

Array = NDArray[np.float64]
Shape = tuple[int, ...]


class Answers(Protocol):
    """What came back for one batch of calls (the sandbox's `Outputs` is one)."""

    @property
    def outcome(self) -> NDArray[np.uint8]:
        """One code a call; 0 where it returned numbers."""

    @property
    def shapes(self) -> list[Shape]:
        """One shape a returned array, as the student returned it."""

    @property
    def offsets(self) -> NDArray[np.int64]:
        """Where each array begins in `data`, and the end."""

    @property
    def data(self) -> Array:
        """All numbers, one after the other."""


Met = tuple[Case, tuple[Array, ...] | None]
"""A call with the arrays that came; None where there were no numbers."""
Pattern = Callable[[Sequence[Met]], bool]


@dataclass(frozen=True)
class Slip:
    """A known mistake: a wrong implementation of one stage, its name, and a hint that teaches.

    Parameters
    ----------
    identifier : str
        In snake_case; stands in results and reports.
    name : str
        One sentence that says what is wrong.
    hint : str
        Leads to the idea without writing the line of code.
    function : callable
        The wrong implementation, with the signature of the stage's function.
    catalogue : str
        Identifiers of the same mistake in the literature that the course keeps.
    minimum_poses : int
        Smallest number of poses on which the mistake can be seen.
    pattern : callable or None
        Says of all calls with what came whether they show this mistake, where its numbers depend on a constant of
        the student's or on rounding; None where the mistake answers as `function` does.
    remembers : bool
        Whether what it answers depends on the calls before; its memory is the function's `__dict__`.
    """

    identifier: str
    name: str
    hint: str
    function: Callable[..., Any]
    catalogue: str = ""
    minimum_poses: int = 2
    pattern: Pattern | None = None
    remembers: bool = False


@dataclass(frozen=True)
class Batch:
    """The expected answers to a batch of calls, flat: judged with a few operations on whole arrays.

    `starts` and `ends` delimit the arrays in `data`; `calls` says at which array each call begins.
    """

    shapes: list[Shape]
    starts: NDArray[np.int64]
    ends: NDArray[np.int64]
    data: Array
    tolerance: Array
    parts: int


class Stage(ABC):
    """One stage of the homework. A subclass a file, one instance named `STAGE` in it.

    Attributes
    ----------
    name, function : str
        The stage's name and the function of the submission that it calls.
    title : str
        A heading for reports.
    position : int
        Place in the order of the stages.
    points : float
        Points where the course file says nothing.
    parts : int
        How many arrays one call returns.
    ladder : Ladder
        Where its cases come from: one rung, one check.
    shares : dict
        Share of the points for each rung of the ladder; they add up to 1.
    takes_truth : bool
        Whether truth values are a proper answer.
    builds_on : tuple of str
        Functions of the submission that this one may call. Where it is wrong and one of them is
        too, it is asked once more with right answers in their place.
    """

    name: str
    function: str
    title: str
    position: int
    points: float
    bonus: bool = False
    parts: int = 1
    ladder: Ladder
    shares: dict[str, float]
    takes_truth: bool = False
    builds_on: tuple[str, ...] = ()

    def facet(self, rung: str) -> Stage:
        """Return the stage as one rung sees it: itself, unless its checks call different functions."""
        return self

    def calls(self, case: Case) -> list[Case]:
        """Arguments of the calls that one case needs, in order."""
        return [case]

    @abstractmethod
    def expected(self, *arguments: Any) -> tuple[Array, ...]:
        """Return the right answer to one call, by the reference."""

    def shapes(self, *arguments: Any) -> list[Shape]:
        """Return the shape of every array of the right answer; a stage may know them without the answer."""
        return [array.shape for array in self.expected(*arguments)]

    @abstractmethod
    def prepare(self, cases: Sequence[Case]) -> Any:
        """Work out once, for all submissions, what the verdict on these cases needs."""

    @abstractmethod
    def layout(self, prepared: Any) -> Batch:
        """Return the shapes that the first round of calls should return."""

    def follow_up(self, prepared: Any, answers: Answers) -> list[Case] | None:
        """Return a second round of calls that depends on the first answers, where the stage asks one."""
        return None

    @abstractmethod
    def judge(self, prepared: Any, answers: Answers, again: Answers | None = None) -> NDArray[np.bool_]:
        """Say for each case whether the answers are right."""

    @abstractmethod
    def explain(self, case: Case, got: tuple[Array, ...]) -> str:
        """Say in the subject's words what is wrong with finite numbers of the right shape.

        `got` holds all arrays that the calls of the case returned, in order.
        """


class ArrayStage(Stage):
    """A stage whose function returns arrays that are compared with the reference's, entry by entry."""

    @abstractmethod
    def tolerance(self, *arguments: Any) -> tuple[Array, ...]:
        """Return how far each entry may be off; derived from rounding in the numbers of the call."""

    def prepare(self, cases: Sequence[Case]) -> Batch:
        """Stack expected values and tolerances of all cases."""
        calls = [call for case in cases for call in self.calls(case)]
        answers = [self.expected(*call) for call in calls]
        arrays = [array for answer in answers for array in answer]
        allowed = [
            np.broadcast_to(tolerance, array.shape)
            for call, answer in zip(calls, answers, strict=True)
            for tolerance, array in zip(self.tolerance(*call), answer, strict=True)
        ]
        ends = np.cumsum([array.size for array in arrays])
        return Batch(
            shapes=[array.shape for array in arrays],
            starts=np.concatenate([[0], ends[:-1]]).astype(np.int64),
            ends=ends.astype(np.int64),
            data=np.concatenate([array.ravel() for array in arrays]),
            tolerance=np.concatenate([tolerance.ravel() for tolerance in allowed]),
            parts=self.parts,
        )

    def layout(self, prepared: Batch) -> Batch:
        """Return the expected answers themselves."""
        return prepared

    def judge(self, prepared: Batch, answers: Answers, again: Answers | None = None) -> NDArray[np.bool_]:
        """Compare every entry with its tolerance; a call is right if all its entries are."""
        got, usable = aligned(prepared, answers)
        with np.errstate(invalid="ignore"):  # inf - inf is nan, and nan is never within tolerance
            close = np.abs(got - prepared.data) <= prepared.tolerance
        right = np.logical_and.reduceat(close, prepared.starts) & usable
        return np.asarray(right.reshape(-1, prepared.parts).all(axis=1))


def aligned(prepared: Batch, answers: Answers) -> tuple[Array, NDArray[np.bool_]]:
    """Lay the answers over the expected ones: their numbers, and which arrays have a usable shape.

    Numbers of unusable arrays are nan.
    """
    n = len(prepared.shapes)
    if answers.shapes == prepared.shapes and answers.data.size == prepared.data.size:
        return answers.data, np.ones(n, dtype=np.bool_)
    got = np.full(prepared.data.size, np.nan)
    usable = np.zeros(n, dtype=np.bool_)
    for index, (shape, wanted) in enumerate(zip(answers.shapes, prepared.shapes, strict=True)):
        lo, hi = answers.offsets[index], answers.offsets[index + 1]
        start, end = prepared.starts[index], prepared.ends[index]
        if shape == wanted and hi - lo == end - start:
            got[start:end] = answers.data[lo:hi]
            usable[index] = True
    return got, usable
