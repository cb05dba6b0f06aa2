"""Feedback for Moodle's "Upload multiple feedback files in a zip": a page in everybody's folder."""

from __future__ import annotations

from collections.abc import Mapping

from autograder.exports.bundle import bundle
from autograder.verdicts import Result

PAGE = "feedback.html"


def feedback_archive(folders: Mapping[int, str], owners: Mapping[int, Result], pages: Mapping[str, bytes]) -> bytes:
    """Pack the pages.

    Parameters
    ----------
    folders : mapping
        Line of the worksheet -> name of the student's folder.
    owners : mapping
        Line of the worksheet -> the student's result.
    pages : mapping
        Submission -> the student's page.
    """
    return bundle({f"{folders[line]}/{PAGE}": pages[result.submission] for line, result in owners.items()})
