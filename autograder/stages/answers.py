"""Stage `answers`: what a student reports for the variant on record, the iterates and the conclusion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from assignment.posegraph import PoseGraph
from autograder.problems.conclusion import RIGHT, choice_of, choices
from autograder.stages.base import Array
from autograder.stages.wording import vector

NAME = "answers"
TITLE = "Iterates and conclusion"
POINTS = 5.0
SHARES = {"iterates": 0.6, "conclusion": 0.4}
CLOSE = 1e-6  # of the largest position: rounding passes, four decimals of a number with more do not

# What to think about, for each wrong belief.
HINTS = {
    "reached_truth": "Compare x^(1) with the true positions in the table after the step: are they the same?",
    "few_poses": "Take a graph with more poses, and count the steps until they are zero.",
    "good_start": "Begin somewhere far away, and compare the point after one step.",
    "loop_closed": "Evaluate f at x^(1): is every row 0?",
    "float_noise": "Compare the size of the second step with the rounding of a float64 of the size of x.",
}


@dataclass(frozen=True)
class Sheet:
    """The variant on record, as far as its answers go.

    Parameters
    ----------
    variant : str
        Identifier of the variant; the order of the choices follows from it.
    graph : PoseGraph
        The student's graph.
    iterates : (4, n) float array
        The right iterates x^(0) .. x^(3) [m].
    """

    variant: str
    graph: PoseGraph
    iterates: Array


@dataclass(frozen=True)
class Finding:
    """What is to be said of one answer: whether it is there, whether it is right, and why not."""

    given: bool
    right: bool
    message: str = ""
    slip: str | None = None
    hint: str = ""


def iterates_finding(sheet: Sheet, got: Array | None, bad: str = "") -> Finding:
    """Compare the reported iterates with those of the variant on record."""
    wanted = sheet.iterates
    if got is None:
        words = f"iterates: {bad}, expected an array of shape {wanted.shape}." if bad else ""
        return Finding(bool(bad), False, words or "iterates is unfinished: it is None.")
    if got.shape != wanted.shape:
        return Finding(True, False, f"iterates has shape {got.shape}, expected {wanted.shape}: a row for each iterate.")
    if not np.isfinite(got).all():
        return Finding(True, False, "iterates holds nan or inf, expected finite numbers.")
    off = np.abs(got - wanted) > CLOSE * (1.0 + np.abs(wanted).max())
    if not off.any():
        return Finding(True, True)
    row = int(np.argmax(off.any(axis=1)))
    where = "the start of your own graph" if row == 0 else "your own graph"
    return Finding(
        True, False, f"row {row} of iterates, x^({row}), is {vector(got[row])}: it does not belong to {where}."
    )


def conclusion_finding(sheet: Sheet, got: str | None, bad: str = "") -> Finding:
    """Compare the choice that a letter names with the right one."""
    if got is None:
        return Finding(bool(bad), False, f"conclusion: {bad}." if bad else "conclusion is unfinished: it is None.")
    choice = choice_of(sheet.variant, got)
    if choice is None:
        last = choices(sheet.variant)[-1].letter
        return Finding(True, False, f"conclusion is {got[:20]!r}, expected one letter from A to {last}.")
    if choice.identifier == RIGHT:
        return Finding(True, True)
    words = f"Choice {choice.letter} is not the reason."
    return Finding(True, False, words, choice.identifier, HINTS.get(choice.identifier, ""))


def follows(start: Array, steps: Array, got: Array | None) -> bool:
    """Whether reported iterates are those of the student's own steps from the start.

    Steps that are zero, or that lead to zero, show no work that could follow from anything.

    Parameters
    ----------
    start : (n,) float array
        The start on record.
    steps : (3, n) float array
        The student's own dx at each of the first three of these iterates.
    got : (4, n) float array or None
        What was reported.

    Examples
    --------
    >>> follows(np.zeros(2), np.ones((3, 2)), np.arange(4.0)[:, None] * np.ones(2))
    True
    """
    own = np.vstack([start, start + np.cumsum(steps, axis=0)])
    if got is None or got.shape != own.shape or not np.isfinite(own).all():
        return False
    close = CLOSE * (1.0 + np.abs(own).max())
    if np.abs(steps).max() <= close or np.abs(own[1]).max() <= close:
        return False
    return bool((np.abs(got - own) <= close).all())
