"""Stage `residual`: the vector f on given (x, graph)."""

from __future__ import annotations

import numpy as np

from assignment.posegraph import PoseGraph
from autograder.problems.cases import Case
from autograder.problems.ladders import GRAPHS
from autograder.stages.base import Array, ArrayStage, Shape
from autograder.stages.wording import beside, factor
from reference_solution import slam1d


class Residual(ArrayStage):
    """Asks for f(x), shape (m,) [m]."""

    name = function = "residual"
    title = "Residual f"
    position = 1
    points = 15.0
    ladder = GRAPHS
    shares = {
        "worked_example": 0.1,
        "single_loops": 0.2,
        "several_loops": 0.2,
        "priors": 0.2,
        "variances": 0.05,
        "real_valued": 0.2,
        "many_poses": 0.05,
    }

    def expected(self, x: Array, graph: PoseGraph) -> tuple[Array, ...]:
        """Return f(x)."""
        return (slam1d.residual(x, graph),)

    def shapes(self, x: Array, graph: PoseGraph) -> list[Shape]:
        """Return (m,)."""
        return [(graph.n_factors,)]

    def tolerance(self, x: Array, graph: PoseGraph) -> tuple[Array, ...]:
        """Allow 1e-9 of the numbers that a row adds up: far above rounding, far below four decimals."""
        i, j = graph.edges.T
        between = np.abs(x[i]) + np.abs(graph.measurements) + np.abs(x[j])
        prior = np.abs(x[graph.priors]) + np.abs(graph.prior_means)
        return (1e-9 * (1.0 + np.concatenate([between, prior])),)

    def explain(self, case: Case, got: tuple[Array, ...]) -> str:
        """Name the first wrong row, what came and what was expected."""
        x, graph = case
        f = self.expected(x, graph)[0]
        row = int(np.argmax(~(np.abs(got[0].ravel() - f) <= self.tolerance(x, graph)[0])))
        return f"{factor(graph, row)} of f: {beside(got[0].ravel()[row], f[row])} [m]."


STAGE = Residual()
