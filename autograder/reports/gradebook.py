"""grades.csv: one row a submission, one column a stage, safe to open in a spreadsheet."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Sequence
from pathlib import Path

from autograder.reports.summary import provisional
from autograder.verdicts import Result
from autograder.writing import write_whole

COLUMNS = ("submission", "student_id", "variant", "status", "score", "max_score")
NOTE = "note"  # the last column
# What makes a spreadsheet run a cell instead of showing it, also behind blanks and in full width.
_STARTS_A_FORMULA = "=+-@|%\uff1d\uff0b\uff0d\uff20"
_CONTROL = re.compile(r"[\x00-\x1f\x7f\x85\u2028\u2029]")


def write_gradebook(results: Iterable[Result], path: Path, stages: Sequence[str] = ()) -> None:
    """Write grades.csv in one step: a reader sees the old file or the new one, never half of it.

    Parameters
    ----------
    results : iterable of Result
        One row each, in the given order.
    path : Path
        The file to write.
    stages : sequence of str
        Stages that have a column even where no result knows them, in their order.
    """
    write_whole(path, gradebook_text(results, stages).encode())


def gradebook_text(results: Iterable[Result], stages: Sequence[str] = ()) -> str:
    """Lay out grades.csv; a grader_error has an empty score, for our fault is no zero.

    Examples
    --------
    >>> broken = Result(submission="=1+1", status="grader_error", score=None, max_score=90.0, confinement="full",
    ...                 seed=0, grader_version="0", fingerprint="", seconds=0.0)
    >>> print(gradebook_text([broken], ["residual"]), end="")
    submission,student_id,variant,status,score,max_score,residual,note
    '=1+1,,worked-example,grader_error,,90,,
    """
    results = list(results)
    names = list(dict.fromkeys([*stages, *(stage.name for result in results for stage in result.stages)]))
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow([*COLUMNS, *names, NOTE])
    for result in results:
        scores = {stage.name: "" if stage.status == "awaiting_mark" else exact(stage.score) for stage in result.stages}
        row = [
            defused(result.submission),
            defused(result.student_id or ""),
            defused(result.variant),
            result.status,
            "" if result.score is None else exact(result.score),
            exact(result.max_score),
        ]
        writer.writerow([*row, *(scores.get(name, "") for name in names), defused(remark(result))])
    return file.getvalue()


def remark(result: Result) -> str:
    """Say what a reader of the numbers must know: what is provisional, and what was changed by hand or by a rule."""
    return "; ".join(filter(None, [provisional([result]), *(each.said for each in result.adjustments)]))


def defused(text: str) -> str:
    """Put an apostrophe before text that a spreadsheet would take for a formula; keep it on one line.

    Examples
    --------
    >>> defused("=cmd|' /C calc'!A0"), defused(" @SUM(A1)"), defused("alice")
    ("'=cmd|' /C calc'!A0", "' @SUM(A1)", 'alice')
    """
    text = _CONTROL.sub(" ", text)
    return "'" + text if text.lstrip()[:1] in tuple(_STARTS_A_FORMULA) else text


def exact(value: float) -> str:
    """Write a number without idle zeros and without losing a point.

    Examples
    --------
    >>> exact(87.5), exact(100.0), exact(20 / 3)
    ('87.5', '100', '6.66666666667')
    """
    return f"{value + 0.0:.12g}"
