"""A small class for another grader: the reference, the stub as it was handed out, and slips of every stage."""

from __future__ import annotations

import copy
from collections.abc import Callable
from pathlib import Path
from typing import Any

import nbformat

from autograder.exports.notebooks.questions import answer_code
from autograder.problems.problem import worked_problem
from autograder.stages.catalogue import slips, stage
from autograder.stages.slips.submission import submission_text
from reference_solution import slam1d

REFERENCE = Path(slam1d.__file__).read_text(encoding="utf-8")
SLIPS = {
    "residual": "loop_residual_without_measurement",
    "jacobian": "",
    "information_matrix": "",
    "normal_equations": "",
    "gauss_newton_step": "",
    "second_step": "",
}


def texts() -> dict[str, str | None]:
    """Return the class: name -> the code of the functions; None is the stub as it was handed out."""
    found: dict[str, str | None] = {"reference": REFERENCE, "stub": None}
    for name, wanted in SLIPS.items():
        slip = next(one for one in slips(name) if wanted in ("", one.identifier))
        found[f"{name.replace('_', '-')}-slip"] = submission_text(slip, stage(name).function)
    return found


def notebook(released: Path, code: str | None, is_stub: Callable[[Any], bool], is_answer: Callable[[Any], str]) -> str:
    """Fill a released notebook in: all functions into the first cell that asks for one, answers into theirs."""
    filled = copy.deepcopy(nbformat.read(released, as_version=4))
    if code is not None:
        answers = answer_code(worked_problem())
        text = code
        for cell in filled.cells:
            if is_stub(cell):
                cell.source, text = text, "pass"
            elif is_answer(cell):
                cell.source = answers[is_answer(cell)]
            elif cell.cell_type == "markdown":
                cell.source = cell.source.replace("YOUR ANSWER HERE", "The second step is zero, for f is affine.")
    return str(nbformat.writes(filled, version=4))
