"""Facts about a pose graph that the grader needs: its information matrix, its loops, a changed copy."""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from assignment.posegraph import PoseGraph

MAX_CONDITION = 1e6
MAX_STATE = 100.0  # [m]
MAX_POSES = 100
MAX_MEASUREMENT = 200.0  # [m]
VARIANCES = (1e-5, 1e3)  # from, to [m^2]
WEIGHTS = (1e-3, 1e5)  # from, to, where Omega is given [1/m^2]
MAX_RESIDUAL = 1e3  # where f is given [m]


def information(graph: PoseGraph) -> np.ndarray:
    """Return the information matrix H of the state, straight from the factors.

    Examples
    --------
    >>> information(PoseGraph(2, [(0, 1)], [1.0], [0.5], [0], [0.0], [0.25]))
    array([[ 6., -2.],
           [-2.,  2.]])
    """
    H = np.zeros((graph.n_poses, graph.n_poses))
    i, j = graph.edges.T
    w = 1.0 / graph.edge_variances
    np.add.at(H, (i, i), w)
    np.add.at(H, (j, j), w)
    np.add.at(H, (i, j), -w)
    np.add.at(H, (j, i), -w)
    np.add.at(H, (graph.priors, graph.priors), 1.0 / graph.prior_variances)
    return H


def well_posed(x: np.ndarray, graph: PoseGraph) -> bool:
    """Whether a case keeps the bounds of the contract: cond(H) <= 1e6, |x| <= 100, and those of the graph.

    A graph with a connected part that has no prior has a singular H, so it breaks the first.
    """
    variances = np.concatenate([graph.edge_variances, graph.prior_variances])
    return bool(
        np.linalg.cond(information(graph)) <= MAX_CONDITION
        and np.abs(x).max() <= MAX_STATE
        and graph.n_poses <= MAX_POSES
        and np.abs(graph.measurements).max() <= MAX_MEASUREMENT
        and VARIANCES[0] <= variances.min()
        and variances.max() <= VARIANCES[1]
    )


def tells(states: np.ndarray, graph: PoseGraph) -> bool:
    """Whether two states to start from and a graph show what a step is worth.

    The states differ by at least 1 m, the graph has a loop, and the minimum moves by at least 2 cm
    when any measurement on a loop changes by 1 m: that is seen above all rounding where the
    numbers of the case are below 1e4 once they are multiplied by the root of cond(H).
    """
    rows = loop_edges(graph)
    if not rows or np.abs(states[0] - states[1]).max() < 1.0:
        return False
    inverse = np.linalg.inv(information(graph))
    i, j = graph.edges[rows].T
    moves = np.abs(inverse[:, i] - inverse[:, j]).max(axis=0) / graph.edge_variances[rows]
    size = np.abs(states).max() + np.abs(graph.measurements).max()
    return bool(moves.min() >= 0.02 and size * np.sqrt(np.linalg.cond(information(graph))) <= 1e4)


def loop_edges(graph: PoseGraph) -> list[int]:
    """Return the rows of the edges that lie on a loop: those whose ends stay connected without them.

    Examples
    --------
    >>> edges = [(0, 1), (1, 2), (2, 1), (2, 3)]
    >>> loop_edges(PoseGraph(4, edges, [1, 1, -1, 1], [1] * 4, [0], [0], [1]))
    [1, 2]
    """
    pairs = [(int(i), int(j)) for i, j in graph.edges]
    return [row for row, (i, j) in enumerate(pairs) if j in reachable(i, pairs[:row] + pairs[row + 1 :])]


def reachable(start: int, pairs: list[tuple[int, int]]) -> set[int]:
    """Return the poses that edges join to one, itself included.

    Examples
    --------
    >>> reachable(2, [(0, 2), (3, 1), (1, 4)])
    {0, 2}
    """
    reached = {start}
    grew = True
    while grew:
        grew = False
        for i, j in pairs:
            if (i in reached) != (j in reached):
                reached |= {i, j}
                grew = True
    return reached


def with_measurement(graph: PoseGraph, row: int, value: float) -> PoseGraph:
    """Return a copy of the graph in which one edge measured something else."""
    measurements = graph.measurements.copy()
    measurements[row] = value
    return dataclasses.replace(graph, measurements=measurements)


def nudged(graph: PoseGraph, row: int) -> PoseGraph:
    """Return a copy of the graph in which one edge measured 1 m more, or 1 m less; done twice, it is the graph again.

    Examples
    --------
    >>> graph = PoseGraph(2, [(0, 1)], [0.3], [1], [0], [0], [1])
    >>> nudged(graph, 0).measurements, nudged(nudged(graph, 0), 0) == graph
    (array([1.3]), True)
    """
    value = float(graph.measurements[row])
    return with_measurement(graph, row, round(value + (1.0 if math.floor(value) % 2 == 0 else -1.0), 12))


def agreeing(graph: PoseGraph, state: np.ndarray) -> PoseGraph:
    """Return a copy of the graph whose measurements and prior means all agree with one state.

    Examples
    --------
    >>> graph = agreeing(PoseGraph(2, [(0, 1)], [1], [1], [1], [0], [1]), np.array([3.0, 5.0]))
    >>> graph.measurements, graph.prior_means
    (array([2.]), array([5.]))
    """
    i, j = graph.edges.T
    return dataclasses.replace(graph, measurements=state[j] - state[i], prior_means=state[graph.priors])
