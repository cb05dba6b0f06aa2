"""All reports of a run, written into its folder from results alone."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from autograder.reports.feedback import Policy, feedback_page
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
    """
    pages = out / "feedback"
    make_private(pages)
    write_gradebook(results, out / "grades.csv", stages)
    for result in results:
        write_whole(pages / f"{result.submission}.html", feedback_page(result, feedback, course).encode())
    write_whole(out / "report.html", class_page(results, record, course).encode())
