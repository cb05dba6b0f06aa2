"""All reports of a run, written into its folder from results alone."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from autograder.reports.drawable import drawable
from autograder.reports.feedback import Policy
from autograder.reports.gradebook import write_gradebook
from autograder.reports.overview import class_page
from autograder.verdicts import Result
from autograder.writing import make_private, write_whole


def write_reports(
    results: Sequence[Result],
    out: Path,
    record: Mapping[str, Any],
    *,
    stages: Sequence[str] = (),
    feedback: Policy = "full",
    course: str = "1D SLAM",
    later: str = "",
) -> None:
    """Write grades.csv, report.html and a page a student.

    Parameters
    ----------
    results : sequence of Result
        All submissions, sorted.
    out : Path
        The folder of the run.
    record : mapping
        What run.json holds.
    stages : sequence of str
        Stages that have a column in grades.csv even where no result knows them.
    feedback : {"full", "hint", "score"}
        How much a student's page shows.
    course : str
        Title of the homework.
    later : str
        What students are told of what follows, and when.
    """
    pages = out / "feedback"
    make_private(pages)
    write_gradebook(results, out / "grades.csv", stages)
    shown = []
    for result in results:
        drawn, text = drawable(result, feedback, course, later)
        shown.append(drawn)
        write_whole(pages / f"{result.submission}.html", text.encode())
    write_whole(out / "report.html", class_page(shown, record, course).encode())
