"""Real nbgrader releases and marks the exported course; its marks stand side by side with ours."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.exports.interop.conftest import run
from tests.exports.interop.submissions import notebook, texts

SYSTEM = "nbgrader==0.9.6"
READ = """
import json, sys
from nbgrader.api import Gradebook
marks = {}
with Gradebook("sqlite:///gradebook.db") as book:
    for submission in book.assignment_submissions("slam1d"):
        (found,) = submission.notebooks
        marks[submission.student.id] = {
            "cells": {grade.name: grade.auto_score for grade in found.grades},
            "maximum": {grade.name: grade.max_score for grade in found.grades},
            "manual": [grade.name for grade in found.grades if grade.needs_manual_grade],
        }
json.dump(marks, sys.stdout)
"""


def is_stub(cell: Any) -> bool:
    """Whether a released cell asks for a function."""
    mark = cell.metadata.get("nbgrader", {})
    return bool(mark.get("solution") and cell.cell_type == "code" and cell.source.startswith("def "))


def is_answer(cell: Any) -> str:
    """Return the name of the answer that a released cell asks for."""
    name = cell.metadata.get("nbgrader", {}).get("grade_id", "")
    return name if name in {"iterates", "conclusion"} else ""


def by_stage(cells: dict[str, float]) -> dict[str, float]:
    """Add the marks of the cells up to those of the stages."""
    found: dict[str, float] = {}
    for name, score in cells.items():
        stage = name.split("-")[0]
        found[stage] = round(found.get(stage, 0.0) + (score or 0.0), 6)
    return found


@pytest.fixture(scope="module")
def marked(
    tmp_path_factory: pytest.TempPathFactory, environment: Callable[..., Path], grader: Callable[..., None]
) -> tuple[dict[str, Any], dict[str, Any], Path]:
    """Export, release, hand in and mark, by nbgrader and by us: both marks, and the folder of the course."""
    bin_folder = environment(SYSTEM, "numpy>=2.2", "ipykernel")
    place = tmp_path_factory.mktemp("nbgrader")
    course = place / "course"
    grader("export", "nbgrader", "-o", course)
    run([bin_folder / "nbgrader", "generate_assignment", "slam1d"], course)
    released = course / "release" / "slam1d" / "slam1d.ipynb"
    for student, code in texts().items():
        folder = course / "submitted" / student / "slam1d"
        folder.mkdir(parents=True)
        (folder / "slam1d.ipynb").write_text(notebook(released, code, is_stub, is_answer), encoding="utf-8")
    run([bin_folder / "nbgrader", "autograde", "slam1d"], course)
    theirs = json.loads(run([bin_folder / "python", "-c", READ], course))
    grader("grade", course / "submitted", "-o", place / "graded", "--examples", 20)
    ours = {
        path.stem: json.loads(path.read_text(encoding="utf-8"))
        for path in (place / "graded" / "results").glob("*.json")
    }
    return theirs, ours, course


def test_the_release_holds_no_answer(marked: tuple[dict[str, Any], dict[str, Any], Path]) -> None:
    """Solutions, hidden tests and the words for staff are gone; what students fill in is there."""
    text = (marked[2] / "release" / "slam1d" / "slam1d.ipynb").read_text(encoding="utf-8")
    for secret in ("BEGIN SOLUTION", "HIDDEN TESTS", "judge_arrays", "For staff", "J.T @ omega", "SOLUTION.md", "DATA"):
        assert secret not in text, secret
    assert text.count("YOUR CODE HERE") == 7
    assert text.count("YOUR ANSWER HERE") == 2


def test_points_are_those_of_the_course_file(marked: tuple[dict[str, Any], dict[str, Any], Path]) -> None:
    """The maximum of every stage is ours, and two answers wait for a human."""
    theirs, ours, _ = marked
    maximum = {name: score for name, score in by_stage(theirs["reference"]["maximum"]).items() if score}
    expected = {stage["name"]: stage["max_score"] for stage in ours["reference"]["stages"] if not stage["bonus"]}
    assert maximum == expected
    assert sorted(theirs["reference"]["manual"]) == ["written-answer-2", "written-answer-3"]


def test_marks_agree_where_they_should(marked: tuple[dict[str, Any], dict[str, Any], Path]) -> None:
    """Reference and stub have our marks; a slip has them but where nbgrader cannot pay: follow-through."""
    theirs, ours, _ = marked
    assert set(theirs) == set(ours) == set(texts())
    differences = []
    for student in sorted(ours):
        mine = {stage["name"]: stage["score"] for stage in ours[student]["stages"] if not stage["bonus"]}
        other = by_stage(theirs[student]["cells"])
        print(f"{student:28} ours {sum(mine.values()):6.2f}   nbgrader {sum(other.values()):6.2f}")
        for name, score in mine.items():
            if abs(score - other[name]) > 1e-6:
                differences.append((student, name, score, other[name]))
                print(f"    {name}: {score} here, {other[name]} there")
    assert not [row for row in differences if row[0] in {"reference", "stub"}]
    assert {name for _, name, _, _ in differences} <= {"gauss_newton_step", "second_step", "answers"}
    assert all(mine > other for _, _, mine, other in differences)
