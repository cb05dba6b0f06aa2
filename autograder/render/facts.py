"""The numbers that the handout tells, worked out by the reference: none is typed in."""

from __future__ import annotations

import types
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from assignment.posegraph import PoseGraph, Ranging
from autograder.problems.problem import Problem, worked_problem
from autograder.render.stub import reference_source

__all__ = ["BY_HAND", "TWIN", "Solution", "range_experiment", "reference", "row_by_hand", "solve", "solve_worked"]

BY_HAND = 1.0  # where all poses stand in the rows that are worked by hand [m]
TWIN = Ranging(beacon=np.array([2.0, 1.0]), poses=np.array([3]), ranges=np.array([1.3]), variances=np.array([0.01]))


@cache
def reference() -> Any:
    """Run the text of the reference solution, as a submission would be run; its functions by name."""
    module = types.ModuleType("slam1d")
    exec(compile(reference_source(), "slam1d.py", "exec"), module.__dict__)
    return module


@dataclass(frozen=True, eq=False)
class Solution:
    """All matrices of one problem at its start, and what comes after the step."""

    f: np.ndarray
    J: np.ndarray
    omega: np.ndarray
    H: np.ndarray
    b: np.ndarray
    dx: np.ndarray
    x1: np.ndarray
    f1: np.ndarray
    iterates: np.ndarray
    cost: float
    cost1: float
    rmse: float
    rmse1: float


def solve(problem: Problem) -> Solution:
    """Solve a problem with the reference.

    Examples
    --------
    >>> from autograder.problems.problem import worked_problem
    >>> solution = solve(worked_problem())
    >>> round(solution.rmse, 3), round(solution.rmse1, 3), round(solution.cost, 6), round(solution.cost1, 6)
    (0.249, 0.077, 25.0, 5.0)
    """
    right, graph = reference(), problem.graph
    rows = [problem.start]
    for _ in range(3):
        rows.append(rows[-1] + right.gauss_newton_step(rows[-1], graph))
    f, f1 = right.residual(rows[0], graph), right.residual(rows[1], graph)
    J, omega = right.jacobian(rows[0], graph), right.information_matrix(graph)
    H, b = right.normal_equations(J, omega, f)
    return Solution(
        f=f,
        J=J,
        omega=omega,
        H=H,
        b=b,
        dx=rows[1] - rows[0],
        x1=rows[1],
        f1=f1,
        iterates=np.array(rows),
        cost=float(f @ omega @ f),
        cost1=float(f1 @ omega @ f1),
        rmse=float(np.sqrt(np.mean((rows[0] - problem.truth) ** 2))),
        rmse1=float(np.sqrt(np.mean((rows[1] - problem.truth) ** 2))),
    )


@cache
def solve_worked() -> Solution:
    """Solve the worked example, once."""
    return solve(worked_problem())


def row_by_hand(graph: PoseGraph, row: int) -> float:
    """Return one row of f where every pose stands at BY_HAND: easy to work by hand, and not the start."""
    return float(reference().residual(np.full(graph.n_poses, BY_HAND), graph)[row])


def range_experiment(steps: int = 4) -> tuple[list[float], list[float]]:
    """Return the largest entry of each step of the worked example, without and with a range.

    The robot at x_3 measures 1.3 m to a beacon at (2, 1), with variance 0.01.

    Examples
    --------
    >>> line, ranged = range_experiment()
    >>> [f"{size:.1e}" for size in ranged], max(line[1:]) < 1e-12
    (['4.1e-01', '7.0e-03', '6.5e-05', '6.7e-07'], True)
    """
    right, problem = reference(), worked_problem()
    graph = problem.graph
    sizes: tuple[list[float], list[float]] = ([], [])
    for with_range, found in zip((False, True), sizes, strict=True):
        x = problem.start
        for _ in range(steps):
            f, J, weights = right.residual(x, graph), right.jacobian(x, graph), right.information_matrix(graph)
            H, b = right.normal_equations(J, weights, f)
            if with_range:
                J = right.range_jacobian(x, TWIN)
                H_range, b_range = right.normal_equations(
                    J, np.diag(1.0 / TWIN.variances), right.range_residual(x, TWIN)
                )
                H, b = H + H_range, b + b_range
            dx = np.linalg.solve(H, -b)
            found.append(float(np.abs(dx).max()))
            x = x + dx
    return sizes
