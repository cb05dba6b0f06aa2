"""Stage `gauss_newton_step`: dx solves the normal equations of (x, graph), judged by backward error."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assignment.posegraph import PoseGraph
from autograder.problems.cases import Case
from autograder.problems.ladders import GRAPHS
from autograder.stages.base import Answers, Array, Batch, Shape, Stage, aligned
from autograder.stages.earlier import FUNCTIONS
from autograder.stages.wording import beside, number
from reference_solution import slam1d

BACKWARD_ERROR = 1e-7
WEAK = 0.011  # [1/m^2] added to ||H||: a guard of 1e-9 on its diagonal costs nothing where all weights are small


@dataclass(frozen=True)
class Systems:
    """All systems H dx = -b of a batch in one sparse table.

    Entry t of row r is `values[t]` times dx at `columns[t]`; rows begin at `row_starts`. `steps`
    says where each dx lies; `H_norm` is the row-sum norm of each H, `b_scale` the size of the
    terms that each b adds up, and `slack` by how much more than others a case may err.
    """

    values: Array
    columns: NDArray[np.int64]
    row_starts: NDArray[np.int64]
    b: Array
    H_norm: Array
    b_scale: Array
    slack: Array
    steps: Batch


class GaussNewtonStep(Stage):
    """Asks for dx, shape (n,) [m], the solution of H dx = -b.

    The backward error ||H dx + b|| / (||H|| ||dx|| + |b|), in the maximum norm, says how far the
    problem would have to move for dx to be its exact solution. |b| is the size of the terms that b
    adds up, not of their sum: at the minimum b is 0, and the rounding in it is not. A stable solver reaches about
    1e-16; an explicit inverse loses a factor of at most cond(H) <= 1e6; central differences for J
    give about 1e-8. All stay below 1e-7. Rounding dx to four decimals gives about 1e-5.

    Central differences with h = 1e-6 err by the rounding of f over h, 1e-9 for every 4 m that a row adds
    up: so the bound grows with the numbers of the case, to 5e-7 at 400 m. A guard H + 1e-9 I costs nothing either.
    """

    name = function = "gauss_newton_step"
    title = "Gauss-Newton step"
    position = 5
    points = 20.0
    ladder = GRAPHS
    builds_on = FUNCTIONS
    shares = {
        "worked_example": 0.1,
        "single_loops": 0.2,
        "several_loops": 0.15,
        "priors": 0.2,
        "variances": 0.15,
        "real_valued": 0.15,
        "many_poses": 0.05,
    }

    def expected(self, x: Array, graph: PoseGraph) -> tuple[Array, ...]:
        """Return dx by the reference."""
        return (slam1d.gauss_newton_step(x, graph),)

    def shapes(self, x: Array, graph: PoseGraph) -> list[Shape]:
        """Return (n,)."""
        return [(graph.n_poses,)]

    def prepare(self, cases: Sequence[Case]) -> Systems:
        """Form every H and b once, and keep the entries of H that are not 0."""
        systems = [_system(x, graph) for x, graph in cases]
        sizes = [len(b) for _, b in systems]
        ends = np.cumsum(sizes)
        starts = np.concatenate([[0], ends[:-1]]).astype(np.int64)
        entries = [np.argwhere(H) for H, _ in systems]
        rows = np.concatenate([entry[:, 0] + start for entry, start in zip(entries, starts, strict=True)])
        return Systems(
            values=np.concatenate([H[tuple(entry.T)] for (H, _), entry in zip(systems, entries, strict=True)]),
            columns=np.concatenate([entry[:, 1] + start for entry, start in zip(entries, starts, strict=True)]),
            row_starts=np.searchsorted(rows, np.arange(ends[-1])),
            b=np.concatenate([b for _, b in systems]),
            H_norm=np.array([np.abs(H).sum(axis=1).max() for H, _ in systems]),
            slack=np.array([1.0 + float(_reach(x, graph).max()) / 100.0 for x, graph in cases]),
            b_scale=np.array([_b_scale(x, graph) for x, graph in cases]),
            steps=Batch(
                shapes=[(size,) for size in sizes],
                starts=starts,
                ends=ends.astype(np.int64),
                data=np.zeros(int(ends[-1])),
                tolerance=np.zeros(int(ends[-1])),
                parts=1,
            ),
        )

    def layout(self, prepared: Systems) -> Batch:
        """Return the shapes of the steps."""
        return prepared.steps

    def judge(self, prepared: Systems, answers: Answers, again: Answers | None = None) -> NDArray[np.bool_]:
        """Compare every backward error with the bound."""
        dx, usable = aligned(prepared.steps, answers)
        return usable & (backward_errors(prepared, dx) <= BACKWARD_ERROR * prepared.slack)

    def explain(self, case: Case, got: tuple[Array, ...]) -> str:
        """Show what dx leaves of the equations, in the row where it leaves most."""
        H, b = _system(*case)
        dx = got[0].ravel()
        left = H @ dx + b
        row = int(np.argmax(np.abs(left)))
        right = self.expected(*case)[0]
        return (
            f"dx: {beside(dx, right)} [m]; it leaves H dx + b = {number(left[row])} in row {row}, where it should be 0."
        )


def _system(x: Array, graph: PoseGraph) -> tuple[Array, Array]:
    J = slam1d.jacobian(x, graph)
    return slam1d.normal_equations(J, slam1d.information_matrix(graph), slam1d.residual(x, graph))


def _b_scale(x: Array, graph: PoseGraph) -> float:
    """Return the size of the terms of b, and a millionth of what they would be if f did not cancel."""
    size = np.abs(slam1d.residual(x, graph)) + 1e-6 * _reach(x, graph)
    terms = np.abs(slam1d.jacobian(x, graph)).T @ slam1d.information_matrix(graph) @ size
    return float(terms.max())


def _reach(x: Array, graph: PoseGraph) -> Array:
    """Return how large the numbers are that each row of f adds up [m]."""
    i, j = graph.edges.T
    between = np.abs(x[i]) + np.abs(graph.measurements) + np.abs(x[j])
    prior = np.abs(x[graph.priors]) + np.abs(graph.prior_means)
    return np.concatenate([between, prior])


def backward_errors(prepared: Systems, dx: Array) -> Array:
    """Return the backward error of each system for the stacked steps dx; nan where dx holds one."""
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        products = prepared.values * dx[prepared.columns]
        left = np.abs(np.add.reduceat(products, prepared.row_starts) + prepared.b)
        starts = prepared.steps.starts
        scale = (prepared.H_norm + WEAK) * np.maximum.reduceat(np.abs(dx), starts) + prepared.b_scale
        worst = np.maximum.reduceat(left, starts)
        return np.where(scale > 0, worst / scale, worst)


STAGE = GaussNewtonStep()
