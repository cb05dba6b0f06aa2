"""The points of a marking guide, as keys: a row `| question | points | given for |` is one of them."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from markupsafe import Markup

from autograder.reports.prose import prose

KEYS = "qwertasdf"  # beside those of the page: c g n p u v x
_ROW = re.compile(
    r"^\|\s*(?P<question>\w+)\s*\|\s*(?P<points>\d+(?:\.\d+)?)\s*\|\s*(?P<words>.+?)\s*\|\s*$", re.MULTILINE
)


_LETTER = re.compile(r"\*\*[A-Z]\*\* \(`(\w+)`\)")


@dataclass(frozen=True)
class Point:
    """One thing that an answer earns points for, and the key that gives them."""

    key: str
    points: float
    words: Markup


def with_letters(guide: str, letters: Mapping[str, str]) -> str:
    """Name the choices of a guide by the letters that they have in a student's own variant.

    Examples
    --------
    >>> with_letters("- **A** (`few_poses`): takes size for linearity.", {"few_poses": "D"})
    '- **D** (`few_poses`): takes size for linearity.'
    """
    return _LETTER.sub(lambda found: f"**{letters.get(found[1], '?')}** (`{found[1]}`)" if letters else found[0], guide)


def guide_points(guide: str, question: str, most: float) -> list[Point]:
    r"""Read what an answer to a question earns points for; together they are worth all points of the question.

    Examples
    --------
    >>> table = "| question | points | given for |\n|---|---|---|\n| 2 | 1 | numbers |\n| 2 | 1 | rounding |\n"
    >>> [(one.key, one.points) for one in guide_points(table, "2", 5.0)]
    [('q', 2.5), ('w', 2.5)]
    >>> guide_points("Be kind.", "2", 5.0)
    []
    """
    rows = [row for row in _ROW.finditer(guide) if row["question"] == question][: len(KEYS)]
    whole = sum(float(row["points"]) for row in rows)
    if not whole:
        return []
    unit = most / whole
    return [
        Point(key, round(float(row["points"]) * unit, 6), prose(row["words"]))
        for key, row in zip(KEYS, rows, strict=False)
    ]
