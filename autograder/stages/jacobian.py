"""Stage `jacobian`: the matrix J on given (x, graph)."""

from __future__ import annotations

import numpy as np

from assignment.posegraph import PoseGraph
from autograder.problems.cases import Case
from autograder.problems.ladders import GRAPHS
from autograder.stages.base import Array, ArrayStage, Shape
from autograder.stages.wording import beside, factor
from reference_solution import slam1d


class Jacobian(ArrayStage):
    """Asks for J = df/dx, shape (m, n)."""

    name = function = "jacobian"
    title = "Jacobian J"
    position = 2
    points = 15.0
    ladder = GRAPHS
    shares = {
        "worked_example": 0.1,
        "single_loops": 0.25,
        "several_loops": 0.25,
        "priors": 0.2,
        "variances": 0.05,
        "real_valued": 0.1,
        "many_poses": 0.05,
    }

    def expected(self, x: Array, graph: PoseGraph) -> tuple[Array, ...]:
        """Return J(x)."""
        return (slam1d.jacobian(x, graph),)

    def shapes(self, x: Array, graph: PoseGraph) -> list[Shape]:
        """Return (m, n)."""
        return [(graph.n_factors, graph.n_poses)]

    def tolerance(self, x: Array, graph: PoseGraph) -> tuple[Array, ...]:
        """Allow 1e-6 an entry.

        Central differences with h = 1e-6 err by about eps |f| / h = 2e-16 * 200 / 1e-6 = 4e-8 at
        |x| <= 100; they pass with room to spare.
        """
        return (np.full(1, 1e-6),)  # broadcast over all entries

    def explain(self, case: Case, got: tuple[Array, ...]) -> str:
        """Name the first wrong row, or the column where only one column is wrong."""
        x, graph = case
        J = self.expected(x, graph)[0]
        wrong = ~(np.abs(got[0] - J) <= 1e-6)
        columns = np.flatnonzero(wrong.any(axis=0))
        if len(columns) == 1 and wrong.sum() > 1:
            c = int(columns[0])
            return f"column {c} of J (pose {c}): {beside(got[0][:, c], J[:, c])}."
        row = int(np.argmax(wrong.any(axis=1)))
        return f"{factor(graph, row)} of J: {beside(got[0][row], J[row])}."


STAGE = Jacobian()
