"""A mark as a cell of a gradebook: rounded, with the decimal sign of the file, of the right maximum."""

from __future__ import annotations

import re
from collections.abc import Iterable

from autograder.errors import UsageError
from autograder.reports.gradebook import exact
from autograder.verdicts import Result

_NUMBER = re.compile(r"\d+(?:[.,]\d+)?")


def mark(score: float, decimal: str = ".") -> str:
    """Write a score with at most four decimals.

    Examples
    --------
    >>> mark(20 / 3), mark(87.5, ","), mark(90.0)
    ('6.6667', '87,5', '90')
    """
    return exact(round(score, 4)).replace(".", decimal)


def value(text: str) -> float | None:
    """Read a number of a gradebook, with a point or a comma; None where it is none.

    Examples
    --------
    >>> value(" 90,00 "), value("90.5"), value("EX")
    (90.0, 90.5, None)
    """
    text = text.strip()
    return float(text.replace(",", ".")) if _NUMBER.fullmatch(text) else None


def same_maximum(results: Iterable[Result], maximum: float | None, where: str) -> None:
    """Raise UsageError where a gradebook's maximum is not that of the results: a mark would mean something else."""
    if maximum is None:
        return
    for result in results:
        if result.status != "grader_error" and abs(result.max_score - maximum) > 1e-9:
            raise UsageError(
                f"{where} is out of {mark(maximum)} points, and the results are out of {mark(result.max_score)}; "
                "change one of them, or give --any-maximum to write the points as they are."
            )
