"""Cells of a source notebook with nbgrader's metadata, schema 3."""

from __future__ import annotations

import re
from typing import Any

import nbformat
from nbformat import NotebookNode

from autograder.exports.notebooks.questions import Check, Question

BEGIN, END = "### BEGIN SOLUTION", "### END SOLUTION"
BEGIN_HIDDEN, END_HIDDEN = "### BEGIN HIDDEN TESTS", "### END HIDDEN TESTS"

FOR_STAFF = f"""\
# Nothing to do in this cell.
{BEGIN_HIDDEN}
# For staff: nbgrader runs the hidden tests in the same process as the student's code. A student who wants to can
# read them there, or make them pass without solving anything; and no follow-through points are given. Use
# `autograder grade` on the collected submissions where marks count: it keeps the answers in another process.
{END_HIDDEN}"""


def solution(cell: NotebookNode, identifier: str, source: str) -> NotebookNode:
    """Make a cell one that the student fills in."""
    return _marked(cell, source, identifier, solution=True)


def manual(cell: NotebookNode, identifier: str, source: str, points: float) -> NotebookNode:
    """Make a cell an answer that a human reads."""
    return _marked(cell, source, identifier, solution=True, grade=True, points=points)


def test(identifier: str, source: str, points: float) -> NotebookNode:
    """Make a new cell of tests."""
    cell: NotebookNode = nbformat.v4.new_code_cell(id=_short(identifier))  # type: ignore[no-untyped-call]  # nbformat has no types
    return _marked(cell, source, identifier, grade=True, locked=True, points=points)


def hidden_test(check: Check) -> NotebookNode:
    """Make the cell of one check: what it asks can be read, how it asks is hidden."""
    source = f"# {check.line}\n{BEGIN_HIDDEN}\n{check.code}\n{END_HIDDEN}"
    return test(check.identifier, source, check.points)


def property_test(question: Question) -> NotebookNode:
    """Make the cell of the checks that need no answer: students see all of it, and it pays nothing."""
    stage = question.stage if question.stage != "answers" else question.cell
    lines = [
        "# You can read this test and run it as often as you like; it pays nothing. The hidden tests below pay.",
        "from self_check import failures",
        "",
        f'for line, wrong in failures("{stage}", globals()):',
        '    assert not wrong, f"{line} {wrong}"',
    ]
    return test(f"{stage}-properties", "\n".join(lines), 0.0)


def _marked(
    cell: NotebookNode,
    source: str,
    identifier: str,
    *,
    grade: bool = False,
    solution: bool = False,
    locked: bool = False,
    points: float | None = None,
) -> NotebookNode:
    metadata: dict[str, Any] = {
        "schema_version": 3,
        "grade_id": re.sub(r"[^a-zA-Z0-9_-]", "-", identifier),
        "grade": grade,
        "solution": solution,
        "locked": locked,
        "task": False,
    }
    if points is not None:
        metadata["points"] = points
    cell.source = source
    cell.metadata = nbformat.from_dict({"nbgrader": metadata})  # type: ignore[no-untyped-call]  # nbformat has no types
    return cell


def _short(identifier: str) -> str:
    """Return an identifier as nbformat allows one for a cell."""
    return re.sub(r"[^a-zA-Z0-9_-]", "-", identifier)[:64]
