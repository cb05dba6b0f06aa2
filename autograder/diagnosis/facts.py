"""What is true of a mistake that nobody has met before, read off its answers to the whole corpus."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assignment.posegraph import PoseGraph
from autograder.problems.cases import Case
from autograder.stages.base import Array, ArrayStage, Stage
from autograder.stages.same import different, finite, off, same

ROWED = ("residual", "jacobian", "information_matrix")  # stages with a row for every factor
FEW = 3  # cases
COARSE = 1e-6  # of the largest entry: an H that is less lopsided than this is symmetric up to rounding


@dataclass(frozen=True)
class Answered:
    """One case with what came back for it; `got` is None where there are no numbers of the right shape."""

    case: Case
    right: bool
    got: tuple[Array, ...] | None


def facts(stage: Stage, answers: Sequence[Answered]) -> list[str]:
    """Return true sentences about a mistake, the most telling first.

    Nothing is said of numbers that are not finite, or not of the right shape: the message says that already.
    """
    if not all(answer.right or (answer.got is not None and finite(*answer.got)) for answer in answers):
        return [_shapes(answers)] if _shapes(answers) else []
    found = [_shapes(answers)]
    if isinstance(stage, ArrayStage) and stage.name in ROWED:
        found.append(_rows(stage, answers))
    if isinstance(stage, ArrayStage) and stage.name == "normal_equations":
        found += _parts(stage, answers)
    return [fact for fact in found if fact]


def _shapes(answers: Sequence[Answered]) -> str:
    """Say so where the graph of one kind is right and all others are wrong: typed in for the worked example, say."""
    right = [_graph(answer) for answer in answers if answer.right]
    wrong = [_graph(answer) for answer in answers if not answer.right]
    graphs = [graph for graph in (*right, *wrong) if graph is not None]
    if not right or not wrong or len(graphs) < len(right) + len(wrong):
        return ""
    for what, of in _LIKENESS.items():
        alike = {of(graph) for graph in right if graph is not None}
        if len(alike) == 1 and not alike & {of(graph) for graph in wrong if graph is not None}:
            return f"It is right for {what.format(*alike)} only."
    return ""


def _graph(answer: Answered) -> PoseGraph | None:
    return next((part for part in answer.case if isinstance(part, PoseGraph)), None)


_LIKENESS: dict[str, Callable[[PoseGraph], object]] = {
    "{} poses": lambda graph: graph.n_poses,
    "graphs with the edges {}": lambda graph: ", ".join(f"{i} -> {j}" for i, j in graph.edges.tolist()),
}

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


def _rows(stage: ArrayStage, answers: Sequence[Answered]) -> str:
    """Name the kind of rows in which all mistakes lie, where there is one that holds them all.

    A row is wrong where the verdict says so: within the same tolerance.
    """
    marked = []
    for answer in answers:
        call = stage.calls(answer.case)[0]
        wanted = stage.expected(*call)[0]
        if answer.got is None or answer.got[0].shape != wanted.shape:
            return ""
        wrong = off(answer.got[0], wanted, stage.tolerance(*call)[0])
        marked.append((answer.case[1], wrong if wrong.ndim == 1 else wrong.any(axis=1)))
    for name, rows_of in _KINDS.items():
        chosen = [(rows_of(graph), wrong) for graph, wrong in marked]
        hit = sum(int((wrong & rows).sum()) for rows, wrong in chosen)
        if sum(bool(wrong.any()) for _, wrong in chosen) < FEW:  # of so few cases a kind would be chance
            return ""
        if hit and not any((wrong & ~rows).any() for rows, wrong in chosen):
            every = hit == sum(int(rows.sum()) for rows, _ in chosen)
            return f"{'All' if every else 'Only'} rows of {name} are wrong{', and no others' if every else ''}."
    return ""


def _parts(stage: ArrayStage, answers: Sequence[Answered]) -> list[str]:
    """Say which of H and b is wrong, and whether H is symmetric."""
    right, wrong, skew = [True, True], [False, False], False
    for answer in answers:
        if answer.got is None:
            return []
        for part, (got, wanted, within) in enumerate(
            zip(answer.got, stage.expected(*answer.case), stage.tolerance(*answer.case), strict=True)
        ):
            right[part] &= same(got, wanted, within)
            wrong[part] |= different(got, wanted, within)
        H = answer.got[0]
        skew |= H.ndim == 2 and different(H, H.T, COARSE * np.abs(H).max(initial=1.0))
    found = ["H is not symmetric, and J^T Omega J always is."] if skew else []
    if wrong[0] and right[1]:
        found.append("b is right on every case; only H is wrong.")
    if wrong[1] and right[0]:
        found.append("H is right on every case; only b is wrong: it is not half the gradient of the cost.")
    return found
