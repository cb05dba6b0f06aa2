"""Graphs for one purpose alone: like those of the exam, and none of them.

Where a step is asked with right functions in the place of a student's own, the answers of these are data beside
the student's code. So no J, Omega or f of theirs may be that of another graph: an edge is split by a new pose until
the exam has no graph of that structure, and all numbers are changed. What a case is made to show stays: loops,
priors and parts, sizes of numbers, how far a state is from the minimum.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from assignment.posegraph import PoseGraph
from autograder.problems.cases import Case
from autograder.problems.graphs import MAX_POSES, VARIANCES, well_posed
from autograder.problems.irregular import jitter

DRAWN = 8  # cases a rung, beside those of its core
_TRIES = 40
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
    """Change a case until its structure is free and it is well posed; None where that takes too long."""
    x, graph = case
    for attempt in range(_TRIES):
        full = graph.n_poses == MAX_POSES
        states, shape = _turned(x, graph) if full else _split(x, graph, attempt)
        made = _renumbered(states, shape, salt)
        free = structure(shape) not in taken
        if free and well_posed(*made):
            return made
        if full or not free:
            x, graph = states, shape
    return None


def _turned(x: np.ndarray, graph: PoseGraph) -> Case:
    """Move the first edge to the end of the list, turned round: where there is no room for another pose."""
    order = np.roll(np.arange(len(graph.edges)), -1)
    edges, measured = graph.edges[order].copy(), graph.measurements[order].copy()
    edges[-1], measured[-1] = edges[-1][::-1].copy(), -measured[-1]
    return x, replace(graph, edges=edges, measurements=measured, edge_variances=graph.edge_variances[order])


def _split(x: np.ndarray, graph: PoseGraph, attempt: int) -> Case:
    """Put a new pose on an edge, numbered behind the lower of its ends, so that a walk stays a walk."""
    row = attempt % len(graph.edges)
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
    between = x[..., i] + share * (x[..., j] - x[..., i])  # so that f is shared out, too
    return np.insert(x, new, between, axis=-1), PoseGraph(
        graph.n_poses + 1,
        edges,
        measured,
        variances,
        graph.priors + (graph.priors >= new),
        graph.prior_means,
        graph.prior_variances,
    )


def _renumbered(x: np.ndarray, graph: PoseGraph, salt: float) -> tuple[np.ndarray, PoseGraph]:
    """Make all lengths shorter by a fifth at most, and every variance larger or smaller by a sixth at most."""
    scale = 0.8 + 0.15 * salt
    k = len(graph.edges)
    variances = np.concatenate([graph.edge_variances, graph.prior_variances])
    variances = np.clip(variances * (1.0 + 0.3 * jitter(len(variances), salt)), *VARIANCES)
    return scale * x, PoseGraph(
        graph.n_poses,
        graph.edges,
        scale * graph.measurements,
        variances[:k],
        graph.priors,
        scale * graph.prior_means,
        variances[k:],
    )


def _salt(name: str) -> float:
    """Return a number in [0, 1) that follows from a name."""
    return int.from_bytes(hashlib.sha256(name.encode()).digest()[:6], "big") / 2**48
