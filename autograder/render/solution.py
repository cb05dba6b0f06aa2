"""The worked solution of one problem, for staff: a notebook that is also a submission, and a page to print."""

from __future__ import annotations

import ast
import os
import tempfile
from functools import cache
from pathlib import Path
from typing import Any

import nbformat
import numpy as np

from autograder.problems.conclusion import RIGHT, choices
from autograder.problems.exact import ExactGraph, decimal
from autograder.problems.families.worked_example import worked_example
from autograder.problems.loops import solve_by_loops
from autograder.problems.problem import Problem
from autograder.render import figure
from autograder.render.facts import Solution, reference, solve, solve_worked
from autograder.render.handout import PROVIDED, alternative, provided, write_files
from autograder.render.notebook import render_notebook
from autograder.render.page import printable
from autograder.render.stub import reference_source
from autograder.render.template import fill
from autograder.render.values import number, values

__all__ = ["execute", "model_answers", "render_solution"]

ROUNDING = 1e-12  # below it a step is rounding [m]
REMARKS = {
    "reached_truth": "takes the minimum of the cost for the truth; show the RMSE that is left.",
    "few_poses": "takes size for linearity; the same happens with a hundred poses.",
    "good_start": "has not tried another start; the notebook has a cell for it.",
    "loop_closed": "takes b = 0 for f = 0; show the residuals after the step.",
    "float_noise": "reads rounding as progress; compare with the size of the measurements.",
}
SHOWN = {
    "residual": "print(residual(my_start, my_graph))",
    "jacobian": "print(jacobian(my_start, my_graph))",
    "information_matrix": "print(np.diag(information_matrix(my_graph)))",
    "normal_equations": "J, omega, f = jacobian(my_start, my_graph), information_matrix(my_graph), "
    'residual(my_start, my_graph)\nH, b = normal_equations(J, omega, f)\nprint(tidy(H))\nprint("b =", tidy(b))',
    "gauss_newton_step": "print(tidy(gauss_newton_step(my_start, my_graph)))",
}


def render_solution(problem: Problem) -> dict[str, str]:
    """Render the worked solution of a problem.

    Parameters
    ----------
    problem : Problem
        First the edges that dead reckoning walks from pose 0, then the loops; one prior, on pose 0.

    Returns
    -------
    dict
        File name -> text: the notebook, not yet executed, and the page, also as HTML to print.

    Raises
    ------
    ValueError
        Where the edges come in another order, or the priors are others.
    """
    filled = {
        **values(problem),
        **_matrices(problem),
        "functions": _functions(),
        "shown": SHOWN,
    }
    page = fill("solution.md.j2", **filled)
    return {
        "slam1d.ipynb": render_notebook("solution.ipynb.j2", **filled),
        "SOLUTION.md": page,
        "SOLUTION.html": printable(page),
    }


def model_answers(problem: Problem) -> str:
    """Render what a student may see after the due date: the way by hand and the model answers, as HTML."""
    own = solve(problem)
    ways = {"truth": problem.truth, "dead reckoning": problem.start, "after one step": own.x1}
    places = {name: list(enumerate(way.round(9).tolist())) for name, way in ways.items()}
    sizes = np.abs(np.diff(own.iterates, axis=0)).max(axis=1)
    steps = {"steps": [(k, size if size > ROUNDING else 0.0) for k, size in enumerate(sizes.tolist(), 1)]}
    pictures = {
        "corridor.svg": figure.curves("Along the corridor", "pose", "position [m]", places, log_y=False),
        "steps.svg": figure.curves("Size of the steps", "step", "largest entry [m]", steps),
    }
    told = {f"{name.removesuffix('.svg')}_text": alternative(drawn) for name, drawn in pictures.items()}
    return printable(fill("model_answers.md.j2", **values(problem), **_matrices(problem), **told), pictures)


@cache
def _functions() -> dict[str, str | None]:
    source = reference_source()
    nodes = [node for node in ast.parse(source).body if isinstance(node, ast.FunctionDef)]
    return {node.name: ast.get_source_segment(source, node) for node in nodes}


def execute(notebook: str) -> str:
    """Run a notebook beside the provided files, and return it with its outputs; nothing in it tells when or where."""
    from nbclient import NotebookClient  # noqa: PLC0415 - only those who render the solution need it

    ran = nbformat.reads(notebook, as_version=4)  # type: ignore[no-untyped-call]  # nbformat has no types
    metadata = dict(ran.metadata)
    with tempfile.TemporaryDirectory() as folder:
        write_files({name: provided(name) for name in PROVIDED}, Path(folder))
        NotebookClient(ran, timeout=120, resources={"metadata": {"path": folder}}).execute(
            # The folder is made here, so that what lies beside the notebook may be looked at; some kernels do not.
            env={**os.environ, "PYTHONPATH": folder, "PYTHONSAFEPATH": ""}
        )
    ran.metadata = metadata
    for cell in ran.cells:
        cell.metadata.pop("execution", None)
        if "outputs" in cell:
            cell.outputs = _joined(cell.outputs)
    text: str = nbformat.writes(ran, version=4)  # type: ignore[no-untyped-call]  # nbformat has no types
    return text + "\n"


def _joined(outputs: list[nbformat.NotebookNode]) -> list[nbformat.NotebookNode]:
    """Join what one stream printed: in how many pieces it arrives depends on how busy the machine is."""
    joined: list[nbformat.NotebookNode] = []
    for output in outputs:
        if joined and output.output_type == "stream" and joined[-1].get("name") == output.name:
            joined[-1].text += output.text
        else:
            joined.append(output)
    return joined


def _matrices(problem: Problem) -> dict[str, Any]:
    own, worked = solve(problem), solve_worked()
    b1 = own.J.T @ own.omega @ own.f1
    listed = choices(problem.variant)
    return {
        "x0": _row(problem.start),
        "f": _row(own.f),
        "J": _matrix(own.J),
        "omega": _row(np.diag(own.omega)),
        "H": _matrix(own.H),
        "b": _row(own.b),
        "dx": _row(own.dx),
        "H_dx": _row(own.H @ own.dx),
        "x1": _row(own.x1),
        "f1": _row(own.f1),
        "b1": _row(b1),
        "loops": _loops(problem),
        "own": {
            "rmse": f"{own.rmse:.3f}",
            "rmse1": f"{own.rmse1:.3f}",
            "cost": number(own.cost),
            "cost1": number(own.cost1),
            "largest": number(np.abs(own.dx).max()),
        },
        "right": next(choice for choice in listed if choice.identifier == RIGHT),
        "wrong_choices": [
            {"letter": choice.letter, "identifier": choice.identifier, "remark": REMARKS[choice.identifier]}
            for choice in listed
            if choice.identifier != RIGHT
        ],
        "errata": _errata(worked),
    }


def _loops(problem: Problem) -> dict[str, Any]:
    """Solve the loops in fractions: variances round and shared R, mismatches e, currents q with R q = e."""
    solved = solve_by_loops(ExactGraph.of(problem.graph))
    return {
        "count": len(solved.forces),
        "mismatch": [decimal(value) for value in solved.mismatches],
        "total": [decimal(row[k]) for k, row in enumerate(solved.matrix)],
        "current": [decimal(value) for value in solved.forces],
        "R": _matrix(np.array(solved.matrix, dtype=np.float64)),
        "e": _row(np.array(solved.mismatches, dtype=np.float64)),
        "q": _row(np.array(solved.forces, dtype=np.float64)),
    }


def _errata(worked: Solution) -> dict[str, str]:
    graph = worked_example()
    printed = worked.H.copy()
    printed[3, 3] = 300.0
    J = worked.J[: len(graph.edges)]
    without_prior, _b = reference().normal_equations(J, np.eye(len(J)), worked.f[: len(J)])
    return {
        "sigma": number(graph.edge_variances[0] ** 0.5),
        "variance": number(graph.edge_variances[0]),
        "weight": number(worked.omega[0, 0]),
        "prior_variance": number(graph.prior_variances[0]),
        "H33": number(worked.H[3, 3]),
        "left": number(abs((printed @ worked.dx + worked.b)[3])),
        "prior_sd": number(graph.prior_variances[0] ** 0.5),
        "ratio": f"{(graph.edge_variances[0] / graph.prior_variances[0]) ** 0.5:.2g}",
        "rank": str(np.linalg.matrix_rank(without_prior)),
        "x1": "(" + ", ".join(number(x) for x in worked.x1) + ")",
        "poses": str(graph.n_poses),
    }


def _row(numbers: np.ndarray) -> str:
    return _matrix(numbers[np.newaxis])


def _matrix(rows: np.ndarray) -> str:
    # \cr ends a row, not two backslashes: some Markdown readers take one of the two for their own escape.
    body = r" \cr ".join(" & ".join(number(value) for value in row) for row in rows)
    return rf"\begin{{pmatrix}} {body} \end{{pmatrix}}"
