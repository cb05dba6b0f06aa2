"""One problem as it is handed to a student: the graph, the state to start from and the true positions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from assignment.posegraph import PoseGraph
from autograder.problems.families.worked_example import worked_example

__all__ = ["Problem", "worked_problem"]


@dataclass(frozen=True, eq=False)
class Problem:
    """A graph with what the handout tells about it.

    Parameters
    ----------
    variant : str
        Identifier of the student's variant; the order of the choices in question 3 follows from it.
    graph : PoseGraph
        The problem.
    start : (n,) float array
        The state to start from [m]: dead reckoning, without the noise of adding floats.
    truth : (n,) float array
        Where the robot really was [m]; nobody would know it outside a homework.
    landmarks : tuple of int
        Unknowns that are landmarks and not poses.
    """

    variant: str
    graph: PoseGraph
    start: np.ndarray
    truth: np.ndarray
    landmarks: tuple[int, ...] = ()


def worked_problem() -> Problem:
    """Return the worked example of the handout as a problem.

    Examples
    --------
    >>> worked_problem().start.tolist()
    [0.0, 1.1, 2.1, 3.2, 0.5]
    """
    graph = worked_example()
    start = graph.dead_reckoning().round(9) + 0.0
    return Problem("worked-example", graph, start, np.array([0.0, 1.0, 2.0, 3.0, 0.0]))
