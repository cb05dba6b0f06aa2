"""A corridor with landmarks, and what elimination does to a sparse matrix; the notebook shows these texts."""

from __future__ import annotations

from functools import cache

import numpy as np

from assignment.posegraph import PoseGraph
from autograder.render.facts import reference
from autograder.render.figure import FILL, INK, svg

__all__ = ["H_IN_WORDS", "J_IN_WORDS", "corridor", "counts", "fill_in", "pairs_of", "patterns", "picture"]

J_IN_WORDS = (
    "The rows of the walk come first: two entries side by side, which move one column to the right from row to row. "
    "In the rows of the observations below, one entry moves along the poses like a staircase, and the other stands "
    "in one of the last columns, those of the landmarks. The last row, the prior, has one entry, in the first column."
)
H_IN_WORDS = (
    "A narrow band of three entries runs along the diagonal of the poses. To the right of it and below it, in the "
    "columns and rows of the landmarks, lies a band from corner to corner: each landmark beside the poses that see it. "
    "The lower right block, landmark against landmark, is a bare diagonal."
)


def corridor() -> PoseGraph:
    """Build a walk of 100 poses past 20 landmarks (unknowns 100 to 119), seen from nearby only."""
    walk = [(i, i + 1) for i in range(99)]
    seen = [(pose, 100 + k) for pose in range(100) for k in range(20) if abs(pose - (5 * k + 2)) <= 10]
    edges = np.array(walk + seen)
    places = np.append(np.arange(100.0), 5.0 * np.arange(20) + 2)
    measured = places[edges[:, 1]] - places[edges[:, 0]]
    variances = np.full(len(edges), 0.01)
    return PoseGraph(120, edges, measured, variances, np.array([0]), np.zeros(1), np.full(1, 0.001))


def picture(graph: PoseGraph, poses: int = 100) -> str:
    """Draw the graph of a corridor: its poses as dots in a row, its landmarks as boxes above, factors as lines."""
    marks = range(poses, graph.n_poses)
    at = {pose: (20.0 + 6.2 * pose, 150.0) for pose in range(poses)}
    at |= {mark: (20.0 + 6.2 * (5 * (mark - poses) + 2), 50.0) for mark in marks}
    lines = "".join("M{:g} {:g}L{:g} {:g}".format(*at[i], *at[j]) for i, j in graph.edges.tolist())
    parts = [f'<path d="{lines}" fill="none" stroke="{INK}" stroke-width=".5"/>']
    parts += [f'<circle cx="{at[k][0]:g}" cy="{at[k][1]:g}" r="2.2" fill="{FILL}"/>' for k in range(poses)]
    parts += [f'<path d="M{at[k][0] - 5:g} {at[k][1] - 5:g}h10v10h-10z" fill="{FILL}"/>' for k in marks]
    x, y = at[int(graph.priors[0])]
    parts.append(f'<path d="M{x:g} {y:g}v20m-4 0h8v8h-8z" fill="{INK}" stroke="{INK}"/>')
    words = ((24, f"{len(marks)} landmarks"), (180, f"{poses} poses, with a prior on the first"))
    parts += [f'<text x="40" y="{y}">{text}</text>' for y, text in words]
    told = (
        f"{poses} poses in a row, each joined to the next, and {len(marks)} landmarks above them, each joined to the "
        "poses from which it was seen, all of them near. No line joins two landmarks."
    )
    return svg(660, 196, "The graph of a corridor with landmarks", told, parts)


def fill_in(pairs: set[frozenset[int]], order: list[int]) -> int:
    """Count the new pairs that come up when unknowns are eliminated in this order."""
    neighbours: dict[int, set[int]] = {unknown: set() for unknown in order}
    for a, b in map(tuple, pairs):
        neighbours[a].add(b)
        neighbours[b].add(a)
    new = 0
    for unknown in order:
        near = neighbours.pop(unknown)
        for a in near:
            neighbours[a].discard(unknown)
            missing = near - neighbours[a] - {a}
            neighbours[a] |= missing
            new += len(missing)
    return new // 2


def pairs_of(graph: PoseGraph) -> set[frozenset[int]]:
    """Return the pairs of unknowns that share a factor."""
    return {frozenset(edge) for edge in graph.edges.tolist()}


def patterns(graph: PoseGraph) -> tuple[list[list[int]], list[list[int]]]:
    """Return where J and H have entries, as rows of 0 and 1."""
    J, H = reference().sparsity_pattern(graph)
    return J.astype(int).tolist(), H.astype(int).tolist()


@cache
def counts() -> dict[str, int]:
    """Count what the handout tells about the corridor.

    Examples
    --------
    >>> told = counts()
    >>> told["between"], told["all_pairs"], told["seen"], told["possible"]
    (99, 4950, 398, 2000)
    >>> told["fill_landmarks_first"], told["fill_poses_first"], told["fill_along"]
    (1527, 991, 88)
    """
    graph = corridor()
    poses, marks = list(range(100)), list(range(100, 120))
    between = sum(1 for _i, j in graph.edges.tolist() if j < 100)
    pairs = pairs_of(graph)
    along = sorted(range(120), key=lambda unknown: unknown if unknown < 100 else 5 * (unknown - 100) + 12.5)
    return {
        "poses": len(poses),
        "landmarks": len(marks),
        "between": between,
        "all_pairs": len(poses) * (len(poses) - 1) // 2,
        "seen": len(graph.edges) - between,
        "possible": len(poses) * len(marks),
        "about": round(len(graph.edges) - between, -2),
        "row": sum(patterns(graph)[1][50][:100]),  # of H, along the walk
        "fill_landmarks_first": fill_in(pairs, marks + poses),
        "fill_poses_first": fill_in(pairs, poses + marks),
        "fill_along": fill_in(pairs, along),
    }
