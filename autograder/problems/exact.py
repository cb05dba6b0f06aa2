"""A pose graph in exact fractions, and its solution by elimination: what staff trust.

The numbers of a variant are short decimals. Here they are kept as fractions, so that "the answer
is (0, -1, -3, -1.8, 0.2)" is a statement that can be true, not merely close.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from assignment.posegraph import PoseGraph

__all__ = ["ExactGraph", "decimal", "eliminate", "floats"]

MOST_DIGITS = 20


@dataclass(frozen=True)
class ExactGraph:
    """The fields of `PoseGraph`, every number a fraction.

    Examples
    --------
    >>> half = Fraction(1, 2)
    >>> graph = ExactGraph(2, ((0, 1),), (half,), (Fraction(1, 4),), (0,), (Fraction(3),), (Fraction(1, 1000),))
    >>> H, b = graph.normal_equations((Fraction(4), Fraction(5)))
    >>> [[int(entry) for entry in row] for row in H], [int(entry) for entry in b]
    ([[1004, -4], [-4, 4]], [998, 2])
    >>> [str(entry) for entry in graph.solution()]
    ['3', '7/2']
    """

    n_poses: int
    edges: tuple[tuple[int, int], ...]
    measurements: tuple[Fraction, ...]
    edge_variances: tuple[Fraction, ...]
    priors: tuple[int, ...]
    prior_means: tuple[Fraction, ...]
    prior_variances: tuple[Fraction, ...]

    @classmethod
    def of(cls, graph: PoseGraph) -> ExactGraph:
        """Read a pose graph whose numbers are short decimals: 0.1 means one tenth."""

        def fractions(values: np.ndarray) -> tuple[Fraction, ...]:
            return tuple(Fraction(repr(value)) for value in values.tolist())

        return cls(
            graph.n_poses,
            tuple((i, j) for i, j in graph.edges.tolist()),
            fractions(graph.measurements),
            fractions(graph.edge_variances),
            tuple(graph.priors.tolist()),
            fractions(graph.prior_means),
            fractions(graph.prior_variances),
        )

    def posegraph(self) -> PoseGraph:
        """Round every number to the nearest float64: what a student's functions are called with."""
        return PoseGraph(
            self.n_poses,
            np.array(self.edges, dtype=np.int64).reshape(-1, 2),
            floats(self.measurements),
            floats(self.edge_variances),
            np.array(self.priors, dtype=np.int64),
            floats(self.prior_means),
            floats(self.prior_variances),
        )

    def dead_reckoning(self) -> tuple[Fraction, ...]:
        """Add up the measurements from the priors, by the rule of `PoseGraph.dead_reckoning`.

        Raises
        ------
        ValueError
            Where a connected part of the graph has no prior to start from.
        """
        x: dict[int, Fraction] = {}
        for pose, mean in zip(self.priors, self.prior_means, strict=True):
            reached = pose not in x
            x.setdefault(pose, mean)
            while reached:
                reached = False
                for (i, j), u in zip(self.edges, self.measurements, strict=True):
                    if (i in x) != (j in x):
                        if i in x:
                            x[j] = x[i] + u
                        else:
                            x[i] = x[j] - u
                        reached = True
        if len(x) < self.n_poses:
            lost = min(set(range(self.n_poses)) - x.keys())
            raise ValueError(f"every connected part must have a prior, got none for the part of pose {lost}")
        return tuple(x[pose] for pose in range(self.n_poses))

    def residual(self, x: Sequence[Fraction]) -> tuple[Fraction, ...]:
        """Evaluate f: x_i + u_ij - x_j for every edge, x_k - mean for every prior."""
        between = tuple(x[i] + u - x[j] for (i, j), u in zip(self.edges, self.measurements, strict=True))
        prior = tuple(x[k] - mean for k, mean in zip(self.priors, self.prior_means, strict=True))
        return between + prior

    def gradient(self, x: Sequence[Fraction]) -> tuple[Fraction, ...]:
        """Evaluate b = J^T Omega f: it is zero at the least-squares solution and nowhere else."""
        b = [Fraction(0)] * self.n_poses
        f = self.residual(x)
        for (i, j), r, v in zip(self.edges, f, self.edge_variances, strict=False):
            b[i] += r / v
            b[j] -= r / v
        for k, r, v in zip(self.priors, f[len(self.edges) :], self.prior_variances, strict=True):
            b[k] += r / v
        return tuple(b)

    def normal_equations(self, x: Sequence[Fraction]) -> tuple[list[list[Fraction]], list[Fraction]]:
        """Form H and b at x; edge by edge, since J has two entries a row."""
        H = [[Fraction(0)] * self.n_poses for _ in range(self.n_poses)]
        for (i, j), v in zip(self.edges, self.edge_variances, strict=True):
            H[i][i] += 1 / v
            H[j][j] += 1 / v
            H[i][j] -= 1 / v
            H[j][i] -= 1 / v
        for k, v in zip(self.priors, self.prior_variances, strict=True):
            H[k][k] += 1 / v
        return H, list(self.gradient(x))

    def solution(self) -> tuple[Fraction, ...]:
        """Solve for the least-squares state, from x = 0: one step is enough, since f is affine in x.

        Raises
        ------
        ValueError
            Where a connected part of the graph has no prior, so that H is singular.
        """
        H, b = self.normal_equations([Fraction(0)] * self.n_poses)
        return eliminate(H, [-entry for entry in b])


def eliminate(matrix: Sequence[Sequence[Fraction]], right: Sequence[Fraction]) -> tuple[Fraction, ...]:
    """Solve matrix * x = right by Gauss elimination in fractions.

    Raises
    ------
    ValueError
        Where the matrix is singular.

    Examples
    --------
    >>> [str(entry) for entry in eliminate([[Fraction(0), Fraction(2)], [Fraction(3), Fraction(1)]], [1, 2])]
    ['1/2', '1/2']
    """
    size = len(matrix)
    rows = [[*row, entry] for row, entry in zip(matrix, right, strict=True)]
    for column in range(size):
        pivot = next((k for k in range(column, size) if rows[k][column]), None)
        if pivot is None:
            raise ValueError(f"the matrix must be regular, got no pivot in column {column}")
        rows[column], rows[pivot] = rows[pivot], rows[column]
        top = rows[column]
        for row in rows[column + 1 :]:
            if row[column]:
                factor = row[column] / top[column]
                for entry in range(column, size + 1):
                    if top[entry]:
                        row[entry] -= factor * top[entry]
    x = [Fraction(0)] * size
    for k in range(size - 1, -1, -1):
        known = sum((rows[k][column] * x[column] for column in range(k + 1, size)), Fraction(0))
        x[k] = (rows[k][size] - known) / rows[k][k]
    return tuple(x)


def floats(values: Sequence[Fraction]) -> np.ndarray:
    """Round fractions to the nearest float64."""
    return np.array([float(value) for value in values], dtype=np.float64)


def decimal(value: Fraction) -> str:
    """Write a fraction in full: as a decimal where it ends, as a quotient where it does not.

    Examples
    --------
    >>> decimal(Fraction(-3, 20)), decimal(Fraction(2)), decimal(Fraction(1, 3))
    ('-0.15', '2', '1/3')
    """
    numerator, denominator = value.numerator, value.denominator
    if denominator == 1:
        return str(numerator)
    digits, power = 0, 1
    while power % denominator:
        if digits == MOST_DIGITS:
            return f"{numerator}/{denominator}"
        digits, power = digits + 1, power * 10
    whole, part = divmod(abs(numerator) * (power // denominator), power)
    return f"{'-' if numerator < 0 else ''}{whole}.{part:0{digits}d}"
