"""Stage `information_matrix`: the weights Omega on a given graph."""

from __future__ import annotations

import numpy as np

from assignment.posegraph import PoseGraph
from autograder.problems.cases import Case
from autograder.problems.ladders import GRAPHS
from autograder.stages.base import Array, ArrayStage, Shape
from autograder.stages.wording import beside, factor, number
from reference_solution import slam1d


class InformationMatrix(ArrayStage):
    """Asks for Omega = diag(1/variance), shape (m, m) [1/m^2]."""

    name = function = "information_matrix"
    title = "Information matrix Omega"
    position = 3
    points = 10.0
    ladder = GRAPHS
    shares = {
        "worked_example": 0.1,
        "single_loops": 0.2,
        "several_loops": 0.15,
        "priors": 0.2,
        "variances": 0.2,
        "real_valued": 0.1,
        "many_poses": 0.05,
    }

    def calls(self, case: Case) -> list[Case]:
        """Only the graph is asked about; the state plays no part."""
        return [(case[1],)]

    def expected(self, graph: PoseGraph) -> tuple[Array, ...]:
        """Return Omega."""
        return (slam1d.information_matrix(graph),)

    def shapes(self, graph: PoseGraph) -> list[Shape]:
        """Return (m, m)."""
        return [(graph.n_factors, graph.n_factors)]

    def tolerance(self, graph: PoseGraph) -> tuple[Array, ...]:
        """Allow 1e-9 of a weight, and of the largest one where 0 is right.

        A guard against dividing by 0 costs nothing: a variance may be off by 1e-12 m^2.
        """
        weights = 1.0 / np.concatenate([graph.edge_variances, graph.prior_variances])
        allowed = np.full((len(weights), len(weights)), 1.1e-9 * weights.max())
        np.fill_diagonal(allowed, weights * (1.1e-9 + 1.1e-12 * weights))
        return (allowed,)

    def explain(self, case: Case, got: tuple[Array, ...]) -> str:
        """Name the first wrong weight, or the entry beside the diagonal that is not 0."""
        _, graph = case
        omega = self.expected(graph)[0]
        wrong = ~(np.abs(got[0] - omega) <= self.tolerance(graph)[0])
        rows = np.flatnonzero(np.diag(wrong))
        if rows.size:
            row = int(rows[0])
            variance = 1.0 / omega[row, row]
            return (
                f"{factor(graph, row)} has variance {number(variance)} m^2: Omega[{row}, {row}] "
                f"{beside(got[0][row, row], omega[row, row])} [1/m^2]."
            )
        i, j = (int(index) for index in np.argwhere(wrong)[0])
        return f"Omega[{i}, {j}] got {number(got[0][i, j])}, expected 0: the measurements are independent."


STAGE = InformationMatrix()
