"""Feedback pages where nbgrader keeps them: feedback/STUDENT/ASSIGNMENT/slam1d.html."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from autograder.errors import UsageError
from autograder.verdicts import Result

_STUDENT = re.compile(r"[^/\\\x00-\x1f+]+")


def feedback_tree(results: Sequence[Result], pages: Mapping[str, bytes], assignment: str) -> dict[str, bytes]:
    """Lay out everybody's page in the student's own folder.

    Raises
    ------
    UsageError
        Where two results are of one student, or an id cannot be a folder.
    """
    files: dict[str, bytes] = {}
    for result in results:
        student = result.student_id or result.submission
        if not _STUDENT.fullmatch(student) or student.startswith("."):
            raise UsageError(f"{student!r} cannot name a folder, so {result.submission} has no place in the tree.")
        path = f"feedback/{student}/{assignment}/slam1d.html"
        if path in files:
            raise UsageError(f"{student} has two results, and feedback has one place for them; grade one of them.")
        files[path] = pages[result.submission]
    return files
