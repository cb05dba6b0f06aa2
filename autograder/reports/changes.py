"""Whose total moved since the reports were last written, and by how much."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from autograder.reports.gradebook import defused, exact
from autograder.reports.wording import points, visible
from autograder.verdicts import Result
from autograder.writing import write_whole

FILE = "changes.csv"
_MOST_LINES = 20


@dataclass(frozen=True)
class Change:
    """One total before and after; None where there was no number."""

    submission: str
    before: float | None
    after: float | None


def read_totals(path: Path) -> dict[str, float | None]:
    """Read the totals of a grades.csv that was written before; none where there is none that can be read."""
    try:
        with path.open(encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        return {row["submission"]: float(row["score"]) if row["score"] else None for row in rows}
    except (OSError, ValueError, KeyError, TypeError, csv.Error):
        return {}


def changes(before: dict[str, float | None], results: Sequence[Result]) -> list[Change]:
    """List those who were there before and have another total now."""
    found = []
    for result in results:
        name = defused(result.submission)
        if name in before and _text(before[name]) != _text(result.score):
            found.append(Change(result.submission, before[name], result.score))
    return found


def changes_text(found: Sequence[Change]) -> str:
    """Say who moved by how much, the largest moves first.

    Examples
    --------
    >>> print(changes_text([Change("ann", 80.0, 82.5), Change("bob", 90.0, 85.0)]))
    2 totals have changed: 1 up, 1 down
      bob  90 -> 85 (-5)
      ann  80 -> 82.5 (+2.5)
    """
    up = sum(_by(one) > 0 for one in found)
    down = sum(_by(one) < 0 for one in found)
    noun = "1 total has" if len(found) == 1 else f"{len(found)} totals have"
    lines = [f"{noun} changed: {up} up, {down} down"]
    wide = max((len(visible(one.submission, 28)) for one in found), default=0)
    for one in sorted(found, key=lambda one: (-abs(_by(one)), one.submission))[:_MOST_LINES]:
        by = _by(one)
        told = f" ({'+' if by > 0 else '-'}{points(abs(by))})" if by else ""
        lines.append(f"  {visible(one.submission, 28):{wide}}  {_shown(one.before)} -> {_shown(one.after)}{told}")
    if len(found) > _MOST_LINES:
        lines.append(f"  and {len(found) - _MOST_LINES} more, see {FILE}")
    return "\n".join(lines)


def write_changes(found: Sequence[Change], out: Path) -> None:
    """Write changes.csv: submission, before, after, by."""
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(("submission", "before", "after", "by"))
    for one in found:
        both = one.before is not None and one.after is not None
        writer.writerow((defused(one.submission), _text(one.before), _text(one.after), exact(_by(one)) if both else ""))
    write_whole(out / FILE, file.getvalue().encode())


def _by(one: Change) -> float:
    return 0.0 if one.before is None or one.after is None else round(one.after - one.before, 6)


def _text(value: float | None) -> str:
    return "" if value is None else exact(value)


def _shown(value: float | None) -> str:
    return "--" if value is None else points(value)
