"""What is true of a mistake that nobody has met before, read off its answers to the whole corpus."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assignment.posegraph import PoseGraph
from autograder.problems.cases import Case
from autograder.stages.base import Array, Stage

ROWED = ("residual", "jacobian", "information_matrix")  # stages with a row for every factor
CLOSE = 1e-6


@dataclass(frozen=True)
class Answered:
    """One case with what came back for it; `got` is None where there are no numbers of the right shape."""

    case: Case
    right: bool
    got: tuple[Array, ...] | None


def facts(stage: Stage, answers: Sequence[Answered]) -> list[str]:
    """Return true sentences about a mistake, the most telling first."""
    if stage.name in ROWED:
        found = [_sizes(answers), _rows(stage, answers)]
    elif stage.name == "normal_equations":
        found = _parts(stage, answers)
    elif stage.name in {"gauss_newton_step", "second_step", "sparsity_pattern"}:
        found = [_sizes(answers)]
    else:
        found = []
    return [fact for fact in found if fact]


def _sizes(answers: Sequence[Answered]) -> str:
    """Say so where one number of poses is right and every other is wrong."""
    right = {answer.case[1].n_poses for answer in answers if answer.right}
    wrong = {answer.case[1].n_poses for answer in answers if not answer.right}
    if len(right) == 1 and not right & wrong:
        return f"It is right for {right.pop()} poses only."
    return ""


# The kinds of rows that a mistake may single out, and how to find them.
_KINDS: dict[str, Callable[[PoseGraph], NDArray[np.bool_]]] = {
    "the second prior": lambda graph: _edges(graph, False, lambda index: index > 0),
    "the priors": lambda graph: _edges(graph, False, lambda _: True),
    "backward edges (j < i)": lambda graph: _edges(graph, True, lambda row: graph.edges[row, 1] < graph.edges[row, 0]),
    "loop closures": lambda graph: _edges(graph, True, lambda row: abs(graph.edges[row, 1] - graph.edges[row, 0]) > 1),
    "doubled edges": lambda graph: _edges(graph, True, lambda row: _is_doubled(graph, row)),
    "the edges": lambda graph: _edges(graph, True, lambda _: True),
}


def _edges(graph: PoseGraph, edges: bool, chosen: Callable[[int], bool]) -> NDArray[np.bool_]:
    """Mark the rows of edges, or of priors, that are chosen."""
    k = len(graph.edges)
    rows = np.zeros(graph.n_factors, dtype=np.bool_)
    for row in range(k) if edges else range(k, graph.n_factors):
        rows[row] = chosen(row if edges else row - k)
    return rows


def _is_doubled(graph: PoseGraph, row: int) -> bool:
    pairs = [frozenset(pair) for pair in graph.edges.tolist()]
    return pairs.count(pairs[row]) > 1


def _rows(stage: Stage, answers: Sequence[Answered]) -> str:
    """Name the kind of rows in which all mistakes lie, where there is one that holds them all."""
    marked = []
    for answer in answers:
        if answer.got is None:
            return ""
        wanted = stage.expected(*stage.calls(answer.case)[0])[0]
        off = ~(np.abs(answer.got[0].reshape(wanted.shape) - wanted) <= CLOSE * (1.0 + np.abs(wanted)))
        marked.append((answer.case[1], off if off.ndim == 1 else off.any(axis=1)))
    for name, rows_of in _KINDS.items():
        chosen = [(rows_of(graph), off) for graph, off in marked]
        if not any((off & ~rows).any() for rows, off in chosen):
            hit = sum(int((off & rows).sum()) for rows, off in chosen)
            every = hit == sum(int(rows.sum()) for rows, _ in chosen)
            return f"{'All' if every else 'Only'} rows of {name} are wrong{', and no others' if every else ''}."
    return ""


def _parts(stage: Stage, answers: Sequence[Answered]) -> list[str]:
    """Say which of H and b is wrong, and whether H is symmetric."""
    wrong_H = wrong_b = skew = False
    for answer in answers:
        if answer.got is None:
            return []
        H, b = answer.got
        right_H, right_b = stage.expected(*answer.case)
        size = np.abs(right_H).max(initial=1.0)
        wrong_H |= not np.abs(H - right_H).max(initial=0.0) <= CLOSE * size
        wrong_b |= not np.abs(b.ravel() - right_b).max(initial=0.0) <= CLOSE * np.abs(right_b).max(initial=1.0)
        skew |= not np.abs(H - H.T).max(initial=0.0) <= CLOSE * np.abs(H).max(initial=1.0)
    found = ["H is not symmetric, and J^T Omega J always is."] if skew else []
    if wrong_H and not wrong_b:
        found.append("b is right on every case; only H is wrong.")
    if wrong_b and not wrong_H:
        found.append("H is right on every case; only b is wrong: it is not half the gradient of the cost.")
    return found
