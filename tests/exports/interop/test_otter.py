"""Real Otter assigns and runs the exported notebook; its marks stand side by side with ours."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.exports.interop.conftest import run
from tests.exports.interop.submissions import notebook, texts

SYSTEM = "otter-grader==7.0.0"
STAGE = {"iterates": "answers", "conclusion": "answers"}
Marked = tuple[dict[str, dict[str, float]], dict[str, Any], Path, dict[str, float]]


def is_stub(cell: Any) -> bool:
    """Whether a cell of the student's notebook asks for a function."""
    return cell.cell_type == "code" and cell.source.startswith("def ") and "NotImplementedError" in cell.source


def is_answer(cell: Any) -> str:
    """Return the name of the answer that a cell of the student's notebook asks for."""
    return cell.source.removesuffix(" = None") if cell.source in {"iterates = None", "conclusion = None"} else ""


def by_stage(tests: list[dict[str, Any]], key: str) -> dict[str, float]:
    """Add the points of the questions up to those of the stages."""
    found: dict[str, float] = {}
    for test in tests:
        name = test["name"].split(" ")[0]
        stage = "written" if name.startswith("written") else STAGE.get(name, name)
        found[stage] = round(found.get(stage, 0.0) + float(test.get(key) or 0.0), 6)
    return found


@pytest.fixture(scope="module")
def marked(
    tmp_path_factory: pytest.TempPathFactory, environment: Callable[..., Path], grader: Callable[..., None]
) -> Marked:
    """Export, assign, hand in and mark, by Otter and by us: both marks, the folder, and Otter's maxima."""
    bin_folder = environment(SYSTEM, "numpy>=2.2", "ipykernel")
    place = tmp_path_factory.mktemp("otter")
    grader("export", "otter", "-o", place / "master")
    run([bin_folder / "otter", "assign", "slam1d.ipynb", "dist"], place / "master")
    released = place / "master" / "dist" / "student" / "slam1d.ipynb"
    (archive,) = (place / "master" / "dist" / "autograder").glob("*.zip")
    (place / "class").mkdir()
    theirs: dict[str, dict[str, float]] = {}
    maximum: dict[str, float] = {}
    for student, code in texts().items():
        path = place / "class" / f"{student}.ipynb"
        path.write_text(notebook(released, code, is_stub, is_answer), encoding="utf-8")
        folder = place / "marks" / student
        folder.mkdir(parents=True)
        run([bin_folder / "otter", "run", "--no-logo", "-a", archive, "-o", folder, path], folder)
        tests = json.loads((folder / "results.json").read_text(encoding="utf-8"))["tests"]
        tests = [test for test in tests if "max_score" in test]
        theirs[student], maximum = by_stage(tests, "score"), by_stage(tests, "max_score")
    grader("grade", place / "class", "-o", place / "graded", "--examples", 20)
    ours = {
        path.stem: json.loads(path.read_text(encoding="utf-8"))
        for path in (place / "graded" / "results").glob("*.json")
    }
    return theirs, ours, released, maximum


def test_the_students_notebook_holds_no_answer(marked: Marked) -> None:
    """Solutions and hidden tests are gone; the stubs are ours."""
    text = marked[2].read_text(encoding="utf-8")
    for secret in ("SOLUTION", "judge_arrays", "J.T @ omega", "HIDDEN", "hidden=True"):
        assert secret not in text, secret
    assert text.count("is not finished yet: replace this line by your code.") == 5


def test_points_are_those_of_the_course_file(marked: Marked) -> None:
    """The maximum of every stage that Otter marks is ours."""
    _, ours, _, maximum = marked
    expected = {stage["name"]: stage["max_score"] for stage in ours["reference"]["stages"] if not stage["bonus"]}
    maximum = {name: points for name, points in maximum.items() if points and name in expected}
    assert maximum == {name: points for name, points in expected.items() if name in maximum}
    assert set(expected) - set(maximum) <= {"written"}


def test_marks_agree_where_they_should(marked: Marked) -> None:
    """Reference and stub have our marks; a slip has them but where Otter cannot pay: follow-through."""
    theirs, ours, _, _ = marked
    assert set(theirs) == set(ours) == set(texts())
    differences = []
    for student in sorted(ours):
        mine = {stage["name"]: stage["score"] for stage in ours[student]["stages"] if not stage["bonus"]}
        other = theirs[student]
        print(f"{student:28} ours {sum(mine.values()):6.2f}   otter {sum(other.values()):6.2f}")
        for name, score in mine.items():
            if abs(score - other.get(name, 0.0)) > 1e-6:
                differences.append((student, name, score, other.get(name, 0.0)))
                print(f"    {name}: {score} here, {other.get(name, 0.0)} there")
    assert not [row for row in differences if row[0] in {"reference", "stub"}]
    assert {name for _, name, _, _ in differences} <= {"gauss_newton_step", "second_step", "answers"}
    assert all(mine > other for _, _, mine, other in differences)
