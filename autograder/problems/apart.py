"""Graphs for one purpose alone: like those of the exam, and none of them.

Where a step is asked with right functions in the place of a student's own, the answers of these are data beside
the student's code. So no J, Omega or f of theirs may be that of another graph: an edge is split by a new pose until
the exam has no graph of that structure, and all numbers are changed. What a case is made to show stays: loops,
priors and parts, sizes of numbers, how far a state is from the minimum.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator
from dataclasses import replace

import numpy as np

from assignment.posegraph import PoseGraph
from autograder.problems.cases import Case
from autograder.problems.graphs import MAX_POSES, well_posed

DRAWN = 8  # cases a rung, beside those of its core
_MOST_NEW = 12  # poses that an edge may be split by
_ROWS = 4  # edges that are tried
Rungs = dict[str, tuple[Case, ...]]
Structure = tuple[int, bytes, bytes]


def ladder_apart(name: str) -> str:
    """Name the cases that are kept apart for a ladder."""
    return f"{name}_apart"


def set_apart(rungs: Rungs, cores: dict[str, int], used: Iterable[PoseGraph], stream: str) -> Rungs:
    """Make cases of graphs that are used nowhere else, for every rung of a ladder.

    Parameters
    ----------
    rungs : dict
        The cases of the exam, (x, graph) or (states, graph), the core of each rung first.
    cores : dict
        How many cases the core of each rung has.
    used : iterable of PoseGraph
        All graphs of the exam.
    stream : str
        The same name gives the same cases.
    """
    taken = {structure(graph) for graph in used}
    found = {}
    for rung, cases in rungs.items():
        core, drawn = cases[: cores[rung]], cases[cores[rung] :]
        chosen = (*core, *drawn[:: max(1, len(drawn) // DRAWN)][:DRAWN])
        made = [_apart(case, taken, _salt(f"{stream}/{rung}/{number}")) for number, case in enumerate(chosen)]
        found[rung] = tuple(case for case in made if case is not None)
    return found


def structure(graph: PoseGraph) -> Structure:
    """Return what J depends on: graphs of another structure have another J."""
    return graph.n_poses, graph.edges.tobytes(), graph.priors.tobytes()


def _apart(case: Case, taken: set[Structure], salt: float) -> Case | None:
    """Give a case another structure, one that is free, and other numbers; None where none is well posed."""
    x, given = case
    for states, graph in _shapes(x, given, taken):
        for factor in (1.15 + 0.2 * salt, 1.0 / (1.15 + 0.2 * salt), 1.0):
            made = _renumbered(states, graph, 0.8 + 0.15 * salt, factor)
            if well_posed(*made):
                return made
    return None


def _shapes(x: np.ndarray, graph: PoseGraph, taken: set[Structure]) -> Iterator[tuple[np.ndarray, PoseGraph]]:
    """Give free structures: with an edge split, and split again while none is free; then with the edges in turn."""
    grown, found = (x, graph), False
    while not found and grown[1].n_poses < min(MAX_POSES, graph.n_poses + _MOST_NEW):
        for row in range(0, len(grown[1].edges), 1 + len(grown[1].edges) // _ROWS):
            split = _split(*grown, row)
            if structure(split[1]) not in taken:
                found = True
                yield split
        grown = _split(*grown, 0)
    turned = x, graph
    for _ in range(2 * len(graph.edges)):
        turned = _turned(*turned)
        if structure(turned[1]) not in taken:
            yield turned


def _turned(x: np.ndarray, graph: PoseGraph) -> tuple[np.ndarray, PoseGraph]:
    """Move the first edge to the end of the list, turned round: where there is no room for another pose."""
    order = np.roll(np.arange(len(graph.edges)), -1)
    edges, measured = graph.edges[order].copy(), graph.measurements[order].copy()
    edges[-1], measured[-1] = edges[-1][::-1].copy(), -measured[-1]
    return x, replace(graph, edges=edges, measurements=measured, edge_variances=graph.edge_variances[order])


def _split(x: np.ndarray, graph: PoseGraph, row: int) -> tuple[np.ndarray, PoseGraph]:
    """Put a new pose on an edge, numbered behind the lower of its ends, so that a walk stays a walk.

    Displacement, variance and error are shared out alike, so that the new pose is where it wants to be.
    """
    i, j = graph.edges[row].tolist()
    new = min(i, j) + 1
    share = 0.4
    edges = graph.edges + (graph.edges >= new)
    first, second = (edges[row, 0], new), (new, edges[row, 1])
    edges = np.concatenate([edges[:row], [first, second], edges[row + 1 :]])
    pieces = np.array([share, 1.0 - share])
    measured = np.concatenate(
        [graph.measurements[:row], pieces * graph.measurements[row], graph.measurements[row + 1 :]]
    )
    variances = np.concatenate(
        [graph.edge_variances[:row], pieces * graph.edge_variances[row], graph.edge_variances[row + 1 :]]
    )
    between = x[..., i] + share * (x[..., j] - x[..., i])
    return np.insert(x, new, between, axis=-1), PoseGraph(
        graph.n_poses + 1,
        edges,
        measured,
        variances,
        graph.priors + (graph.priors >= new),
        graph.prior_means,
        graph.prior_variances,
    )


def _renumbered(x: np.ndarray, graph: PoseGraph, scale: float, factor: float) -> tuple[np.ndarray, PoseGraph]:
    """Multiply all lengths, and all variances."""
    return scale * x, PoseGraph(
        graph.n_poses,
        graph.edges,
        scale * graph.measurements,
        factor * graph.edge_variances,
        graph.priors,
        scale * graph.prior_means,
        factor * graph.prior_variances,
    )


def _salt(name: str) -> float:
    """Return a number in [0, 1) that follows from a name."""
    return int.from_bytes(hashlib.sha256(name.encode()).digest()[:6], "big") / 2**48
