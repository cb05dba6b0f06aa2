"""The subject's words for what a message points at: rows, factors, numbers."""

from __future__ import annotations

import numpy as np

from assignment.posegraph import PoseGraph

DUST = 1e-14  # below it a number is what rounding left


def number(value: float) -> str:
    """Print a number for a student: short, and -0. and the dust of rounding as 0.

    Examples
    --------
    >>> number(-0.0), number(1200.0), number(0.1 + 0.2), number(3.55271e-17)
    ('0', '1200', '0.3', '0')
    """
    if abs(value) < DUST:
        return "0"
    return f"{value:.0f}" if abs(value) < 1e7 and float(value).is_integer() else f"{value:.6g}"


def vector(values: np.ndarray) -> str:
    """Print numbers in square brackets; a long vector is cut in the middle, and rounding noise is 0.

    Examples
    --------
    >>> vector(np.array([1.0, -0.0, 2.5, 1e-16]))
    '[1 0 2.5 0]'
    """
    noise = 1e-12 * np.abs(values).max(initial=0.0)
    shown = [number(0.0 if abs(value) <= noise else value) for value in values.ravel().tolist()]
    if len(shown) > 8:
        shown = [*shown[:4], "...", *shown[-2:]]
    return "[" + " ".join(shown) + "]"


def beside(got: np.ndarray | float, wanted: np.ndarray | float) -> str:
    """Write what came beside what was expected; where they print alike, how far apart they are.

    Examples
    --------
    >>> beside(2.0, 1.5)
    'got 2, expected 1.5'
    >>> beside(2000.0 + 1e-5, 2000.0)
    'got 2000, expected 2000, which is 1e-05 away'
    """
    shown = [number(float(each)) if np.ndim(each) == 0 else vector(np.asarray(each)) for each in (got, wanted)]
    gap = float(np.abs(np.asarray(got) - wanted).max(initial=0.0))
    return f"got {shown[0]}, expected {shown[1]}" + (f", which is {gap:.2g} away" if shown[0] == shown[1] else "")


def factor(graph: PoseGraph, row: int) -> str:
    """Name the factor that a row belongs to.

    Examples
    --------
    >>> graph = PoseGraph(3, [(0, 1), (1, 2), (0, 2)], [1, 1, 2], [1, 1, 1], [0], [0], [1])
    >>> factor(graph, 2), factor(graph, 3)
    ('row 2 (edge 0 -> 2)', 'row 3 (prior on pose 0)')
    """
    k = len(graph.edges)
    if row < k:
        i, j = graph.edges[row].tolist()
        return f"row {row} (edge {i} -> {j})"
    return f"row {row} (prior on pose {int(graph.priors[row - k])})"
