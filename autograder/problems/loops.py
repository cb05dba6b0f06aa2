"""One-loop thinking: mismatches, variances round the loops, forces, and what they do to each edge.

Variances are resistances, a mismatch is a voltage, a force is a current: for one loop, q = e / V.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from autograder.problems.circulation import rounds_of
from autograder.problems.exact import ExactGraph, eliminate

__all__ = ["LoopSolution", "solve_by_loops"]


@dataclass(frozen=True)
class LoopSolution:
    """The solution of a problem by its loops; agrees with the normal equations exactly.

    Parameters
    ----------
    rounds : list
        For each loop the tree edges under it: (row, +1 walked forwards or -1 backwards).
    mismatches : tuple of Fraction
        e: what dead reckoning says of the loop's displacement, minus what was measured [m].
    matrix : list of list of Fraction
        R: variances round the loops on the diagonal, shared variances off it [m^2].
    forces : tuple of Fraction
        q, the solution of R q = e [1/m].
    corrections : tuple of Fraction
        How much shorter each edge becomes, in the order of the edges [m].
    x1 : tuple of Fraction
        The corrected state [m].
    """

    rounds: list[list[tuple[int, int]]]
    mismatches: tuple[Fraction, ...]
    matrix: list[list[Fraction]]
    forces: tuple[Fraction, ...]
    corrections: tuple[Fraction, ...]
    x1: tuple[Fraction, ...]


def solve_by_loops(graph: ExactGraph) -> LoopSolution:
    """Solve a problem by one force for each loop.

    Parameters
    ----------
    graph : ExactGraph
        First the n - 1 edges that dead reckoning walks from pose 0, then the loops; one prior, on pose 0.

    Raises
    ------
    ValueError
        Where the edges come in another order, or the priors are others.

    Examples
    --------
    >>> from autograder.problems.families.worked_example import worked_example
    >>> [str(entry) for entry in solve_by_loops(ExactGraph.of(worked_example())).forces]
    ['10']
    """
    size = graph.n_poses - 1
    tree, loops = graph.edges[:size], graph.edges[size:]
    reached = {0}
    for i, j in tree:
        if i not in reached or j in reached:
            raise ValueError(f"the first {size} edges must lead from pose 0 to every pose, got {i} -> {j} among them")
        reached.add(j)
    if graph.priors != (0,):
        raise ValueError(f"there must be one prior, on pose 0, got priors on {graph.priors}")
    x0 = graph.dead_reckoning()
    rounds = rounds_of(tree, loops)
    variances = graph.edge_variances
    matrix = [
        [
            sum((variances[row] * sign * dict(other).get(row, 0) for row, sign in path), Fraction(0))
            + (variances[size + a] if a == b else 0)
            for b, other in enumerate(rounds)
        ]
        for a, path in enumerate(rounds)
    ]
    mismatches = tuple(x0[j] - x0[i] - z for (i, j), z in zip(loops, graph.measurements[size:], strict=True))
    forces = eliminate(matrix, mismatches)
    corrections = [Fraction(0)] * size + [-v * q for v, q in zip(variances[size:], forces, strict=True)]
    for path, force in zip(rounds, forces, strict=True):
        for row, sign in path:
            corrections[row] += variances[row] * sign * force
    x1 = [graph.prior_means[0]] * graph.n_poses
    for (i, j), u, shorter in zip(tree, graph.measurements, corrections, strict=False):
        x1[j] = x1[i] + u - shorter
    return LoopSolution(rounds, mismatches, matrix, forces, tuple(corrections), tuple(x1))
