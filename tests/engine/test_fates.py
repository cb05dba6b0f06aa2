"""Whoever wrote something hears about it: what is not there, and why, stands first on the page, and staff see it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from autograder.course import Course
from autograder.engine.grade import Settings, grade
from autograder.intake.submission import collect
from autograder.reports.feedback import feedback_page
from autograder.verdicts import Result
from tests.engine.conftest import REFERENCE

DEFINED = REFERENCE.index("def residual(")
BODY = REFERENCE[DEFINED : REFERENCE.index("def jacobian(")]
HEAD, TAIL = REFERENCE[:DEFINED], REFERENCE[DEFINED + len(BODY) :]
LINE = HEAD.count("\n") + 1
AFTER = REFERENCE.count("\n") + 2


def indented(text: str) -> str:
    """Move a text to the right."""
    return "".join(f"    {line}" for line in text.splitlines(keepends=True))


# What was done to residual; its status; words of its message.
MODULES = {
    "colon": (
        BODY.replace(") -> np.ndarray:", ") -> np.ndarray", 1),
        "error",
        f"line {LINE}: SyntaxError: expected ':'",
    ),
    "raises": (f"@1\n{BODY}", "error", f"line {LINE}: TypeError: 'int' object is not callable"),
    "conflict": (
        BODY.replace("    i, j", "<<<<<<< HEAD\n    i, j", 1).rstrip() + "\n=======\n    pass\n>>>>>>> mine\n\n\n",
        "error",
        "git conflict markers",
    ),
    "class": (f"class Slam:\n{indented(BODY)}\n", "error", f"line {LINE + 1} has it in the class Slam"),
    "main": (f"if __name__ == '__main__':\n{indented(BODY)}\n", "error", "in an if that does not hold"),
    "inner": (f"def main():\n{indented(BODY)}\n", "error", "in the function main"),
    "capital": (BODY.replace("def residual", "def Residual"), "missing", "which has Residual"),
    "plural": (BODY.replace("def residual", "def residuals"), "missing", "which has residuals"),
    "value": ("residual = 3\n\n\n", "missing", f"residual is no function: line {LINE} makes it"),
    "unknown": ("residual_of_all = 3\n\n\n", "missing", "residual is not defined in the submission."),
    "newer": (
        "type Vector = np.ndarray\n" + BODY.replace("def residual(", "def residual[T]("),
        "error",
        "does it need a newer",
    ),
}
LATER = {
    "result": ("residual = residual(np.zeros(2), graph)\n", "error", f"line {AFTER + 1} puts"),
    "loop": ("for residual in [1, 2]:\n    pass\n", "error", "puts a loop variable in its place"),
    "import": ("from math import sin as residual\n", "error", "puts an import in its place"),
    "deleted": ("del residual\n", "error", f"line {AFTER} deletes it"),
    "again": ("def residual(x, u):\n    return x - u\n", "error", "defines residual again, with the parameters (x, u)"),
}
GRAPH = "from posegraph import PoseGraph\ngraph = PoseGraph(2, [(0, 1)], [1], [1], [0], [0], [1])\n"


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Result]:
    """All of them, graded as a class."""
    folder = tmp_path_factory.mktemp("uploads")
    for name, (text, _, _) in MODULES.items():
        (folder / f"{name}.py").write_text(HEAD + text + TAIL)
    for name, (text, _, _) in LATER.items():
        (folder / f"{name}.py").write_text(
            f"{REFERENCE}\n{GRAPH[:0]}{text}" if name != "result" else REFERENCE + GRAPH + text
        )
    (folder / "unannotated.py").write_text(REFERENCE.replace("graph: PoseGraph", "graph: Unknown"))
    for name, cells in {
        "writefile": [f"%%writefile slam1d.py\n{REFERENCE}"],
        "unusual": [REFERENCE, "import heapq, bisect, logging, array, weakref, pathlib\nheapq.heapify([2, 1])"],
    }.items():
        (folder / f"{name}.ipynb").write_text(notebook(cells))
    run = grade(collect([folder]), Course(), Settings(examples=4, workers=2), tmp_path_factory.mktemp("out"))
    return {result.submission: result for result in run.results}


def notebook(cells: list[str]) -> str:
    """Write a notebook of code cells below a title."""
    title: dict[str, Any] = {"cell_type": "markdown", "metadata": {}, "source": "# Homework"}
    code = [
        {"cell_type": "code", "metadata": {}, "outputs": [], "execution_count": None, "source": each} for each in cells
    ]
    return json.dumps({"nbformat": 4, "nbformat_minor": 4, "metadata": {}, "cells": [title, *code]})


def residual(result: Result) -> Any:
    """Return the verdict on residual."""
    return next(stage for stage in result.stages if stage.name == "residual")


@pytest.mark.parametrize("name", [*MODULES, *LATER])
def test_the_reason_is_named(results: dict[str, Result], name: str) -> None:
    """Status and message say what became of the function."""
    _, status, words = (MODULES | LATER)[name]
    verdict = residual(results[name])
    assert (verdict.status, verdict.score) == (status, 0.0)
    assert words in verdict.message


@pytest.mark.parametrize("name", [*MODULES, *LATER])
def test_who_tried_is_told_first_and_staff_see_it(results: dict[str, Result], name: str) -> None:
    """The reason stands above the table of stages, and among the flags; for what nobody wrote there is none."""
    result = results[name]
    wrote = name not in {"value", "unknown"}
    page = feedback_page(result, policy="full")
    assert (page.find("Read this first") > 0) == wrote
    assert any("residual" in flag for flag in result.flags) == wrote
    if wrote:
        assert 0 < page.find("Read this first") < page.find("<h2>Stages</h2>")


def test_a_cell_that_was_not_run_is_named(results: dict[str, Result]) -> None:
    """A cell with %%writefile is not run, and its functions are not just missing."""
    verdict = residual(results["writefile"])
    assert verdict.status == "error"
    assert "it stands in cell 2, and the cell begins with %%writefile and was not run" in verdict.message
    assert "So it is with 6 more functions." in results["writefile"].flags


@pytest.mark.parametrize("source", [None, REFERENCE.split("\n")])
def test_a_notebook_that_is_written_oddly_is_graded_in_full_and_flagged(tmp_path: Path, source: Any) -> None:
    """An empty source, and lines without line ends, cost nothing; a human hears of them."""
    cell = {"cell_type": "code", "metadata": {}, "outputs": [], "execution_count": None}
    cells = [{**cell, "source": REFERENCE}, {**cell, "source": source}][source is not None :]
    (tmp_path / "ada.ipynb").write_text(json.dumps({"nbformat": 4, "metadata": {}, "cells": cells}))
    (result,) = grade(collect([tmp_path]), Course(), Settings(examples=4, workers=1), tmp_path / "out").results
    assert [stage.name for stage in result.stages if stage.status != "passed"] == ["answers", "written"]
    assert [flag[:7] for flag in result.flags] == ["Cell 2 " if source is None else "Cell 1 "]


@pytest.mark.parametrize("name", ["unannotated", "unusual"])
def test_what_costs_nothing(results: dict[str, Result], name: str) -> None:
    """An unknown name in an annotation, and a harmless module, cost no point."""
    lost = [stage.name for stage in results[name].stages if stage.status != "passed"]
    assert lost == ["answers", "written"]
    assert results[name].flags == ()
