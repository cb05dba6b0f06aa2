"""A mark as a cell of a gradebook: rounded, with the decimal sign of the file, of the right maximum."""

from __future__ import annotations

import re
from collections.abc import Iterable

from autograder.errors import UsageError
from autograder.reports.gradebook import exact
from autograder.verdicts import Result

_NUMBER = re.compile(r"\d+(?:[.,]\d+)?")
_GROUPED = re.compile(r"\d{1,3}(?:(?P<group>[.,' \u00a0\u2009\u202f\u2019])\d{3})+(?P<rest>(?!(?P=group))[.,]\d+)?")


def mark(score: float, decimal: str = ".") -> str:
    """Write a score with at most four decimals.

    Examples
    --------
    >>> mark(20 / 3), mark(87.5, ","), mark(90.0)
    ('6.6667', '87,5', '90')
    """
    return exact(round(score, 4)).replace(".", decimal)


def value(text: str) -> float | None:
    """Read a number of a gradebook, with a point or a comma, thousands apart or not; None where it is none.

    "1,000" is none: it may be one or a thousand.

    Examples
    --------
    >>> value(" 90,00 "), value("90.5"), value("EX")
    (90.0, 90.5, None)
    >>> value("1,000.00"), value("1.000,00"), value("1'000"), value("1,000"), value("1.234.567")
    (1000.0, 1000.0, 1000.0, None, 1234567.0)
    """
    text = text.strip()
    if grouped := _GROUPED.fullmatch(text):
        if not grouped["rest"] and grouped["group"] in ",." and text.count(grouped["group"]) == 1:
            return None
        whole = text.removesuffix(grouped["rest"] or "")
        return float("".join(filter(str.isdigit, whole)) + (grouped["rest"] or "").replace(",", "."))
    return float(text.replace(",", ".")) if _NUMBER.fullmatch(text) else None


def decimal_sign(text: str) -> str:
    """Return the decimal sign of a number as it stands in a gradebook.

    Examples
    --------
    >>> decimal_sign("100,00"), decimal_sign("1,000.00"), decimal_sign("1.000,00"), decimal_sign("100")
    (',', '.', ',', '.')
    """
    return "," if "," in text.rpartition(".")[2] else "."


def same_maximum(results: Iterable[Result], stated: str, where: str) -> None:
    """Raise UsageError where a gradebook's maximum is not that of the results: a mark would mean something else."""
    maximum = value(stated)
    if maximum is None:
        told = f"has the maximum {stated.strip()!r}, which is no number" if stated.strip() else "states no maximum"
        raise UsageError(
            f"{where} {told}, so whether the points fit cannot be told; export it again, or give --any-maximum to "
            "write the points as they are."
        )
    for result in results:
        if result.status != "grader_error" and abs(result.max_score - maximum) > 1e-9:
            raise UsageError(
                f"{where} is out of {mark(maximum)} points, and the results are out of {mark(result.max_score)}; "
                "change one of them, or give --any-maximum to write the points as they are."
            )
