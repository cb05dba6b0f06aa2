"""A second problem to render, beside the worked example."""

import numpy as np

from assignment.posegraph import PoseGraph
from autograder.problems.problem import Problem


def another_problem():
    """A problem that differs from the worked example in every number."""
    graph = PoseGraph(
        6,
        np.array([(0, 1), (1, 2), (2, 3), (3, 4), (4, 5), (1, 4)]),
        np.array([-0.8, -1.95, 1.45, 2.2, 1.05, 1.5]),
        np.array([0.04, 0.01, 0.05, 0.04, 0.02, 0.01]),
        np.array([0]),
        np.array([2.5]),
        np.array([0.002]),
    )
    return Problem("s1001", graph, graph.dead_reckoning().round(9) + 0.0, np.array([2.5, 2, 0, 1, 3, 4]))
