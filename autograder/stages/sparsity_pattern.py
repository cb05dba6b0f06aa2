"""Bonus stage `sparsity_pattern`: where J and H can differ from 0, from the factors alone."""

from __future__ import annotations

import numpy as np

from assignment.posegraph import PoseGraph
from autograder.problems.cases import Case
from autograder.problems.ladders import GRAPHS
from autograder.stages.base import Array, ArrayStage, Shape
from autograder.stages.wording import factor
from reference_solution import slam1d


class SparsityPattern(ArrayStage):
    """Asks for the masks of J, shape (m, n), and of H, shape (n, n)."""

    name = function = "sparsity_pattern"
    title = "Sparsity pattern"
    position = 7
    points = 5.0
    bonus = True
    parts = 2
    takes_truth = True
    ladder = GRAPHS
    shares = {
        "worked_example": 0.1,
        "single_loops": 0.2,
        "several_loops": 0.25,
        "priors": 0.2,
        "variances": 0.05,
        "real_valued": 0.1,
        "many_poses": 0.1,
    }

    def calls(self, case: Case) -> list[Case]:
        """Only the graph is asked about."""
        return [(case[1],)]

    def expected(self, graph: PoseGraph) -> tuple[Array, ...]:
        """Return both masks as zeros and ones."""
        J_mask, H_mask = slam1d.sparsity_pattern(graph)
        return J_mask.astype(np.float64), H_mask.astype(np.float64)

    def shapes(self, graph: PoseGraph) -> list[Shape]:
        """Return (m, n) and (n, n)."""
        return [(graph.n_factors, graph.n_poses), (graph.n_poses, graph.n_poses)]

    def tolerance(self, graph: PoseGraph) -> tuple[Array, ...]:
        """Allow nothing: a mask is true or false."""
        return np.zeros(1), np.zeros(1)

    def explain(self, case: Case, got: tuple[Array, ...]) -> str:
        """Name the first entry that is marked wrongly."""
        graph = case[1]
        for letter, mine, right in zip(("J", "H"), got, self.expected(graph), strict=True):
            wrong = np.argwhere(mine != right)
            if len(wrong):
                i, j = (int(index) for index in wrong[0])
                where = f"{factor(graph, i)}, pose {j}" if letter == "J" else f"poses {i} and {j}"
                state = "can differ from 0 and is not marked" if right[i, j] else "is always 0 and is marked"
                return f"{letter}_mask[{i}, {j}] ({where}): this entry {state}."
        return "the masks differ from the pattern."


STAGE = SparsityPattern()
