"""What lies beside an answer on the desk: the student's own problem, iterates and choice, and the right ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from markupsafe import Markup

from autograder.reports.feedback import graph_picture
from autograder.reports.wording import number
from autograder.verdicts import Reported

_CLOSE = 1e-6  # of the largest position, as `answers` judges


@dataclass(frozen=True)
class Beside:
    """The other answers of a student, ready for the page.

    Parameters
    ----------
    graph : Markup or None
        The own problem as a picture.
    head : tuple of str
        Names of the poses.
    right, given : tuple
        Rows of (name, entries); an entry of `given` is its text and whether it is wrong.
    reported : Reported
        Words and letters.
    """

    graph: Markup | None
    head: tuple[str, ...]
    right: tuple[tuple[str, tuple[str, ...]], ...]
    given: tuple[tuple[str, tuple[tuple[str, bool], ...]], ...]
    reported: Reported


def beside(reported: Reported | None) -> Beside | None:
    """Lay out what a student reported; None where a result of an earlier version does not hold it."""
    if reported is None:
        return None
    right = reported.right
    close = _CLOSE * (1.0 + max((abs(value) for row in right for value in row), default=0.0))
    wide = max([*map(len, right), *map(len, reported.iterates)], default=0)
    return Beside(
        graph=graph_picture(reported.graph),
        head=tuple(f"x_{k}" for k in range(wide)),
        right=tuple((f"x^({k})", tuple(number(value) for value in row)) for k, row in enumerate(right)),
        given=tuple(
            (f"x^({k})", tuple(_entry(row, right, k, pose, close) for pose in range(len(row))))
            for k, row in enumerate(reported.iterates)
        ),
        reported=reported,
    )


def _entry(
    row: Sequence[float | None], right: Sequence[Sequence[float]], k: int, pose: int, close: float
) -> tuple[str, bool]:
    """Write one number, and say whether it is wrong: off, not finite, or where there should be none."""
    value = row[pose]
    there = k < len(right) and pose < len(right[k])
    return number(value), not (there and value is not None and abs(value - right[k][pose]) <= close)
