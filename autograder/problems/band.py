"""The difficulty band: what makes two variants of a family equally hard, and a good one good.

A band judges finished exact data. It shares no code with the construction, so that it is a check
of it and not an echo.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from fractions import Fraction

from autograder.problems.exact import ExactGraph, decimal

__all__ = ["Band"]

LARGEST_STATE = 100  # the contract judges states up to here [m]
LARGEST_RESIDUAL = 9  # square of the largest residual, in variances: 3 sigma


@dataclass(frozen=True)
class Band:
    """What every variant of a family has in common.

    Parameters
    ----------
    n_poses, loops : int
        Unknowns, and loop closures among the edges.
    products : int
        Edges that get a share of a mismatch: the multiplications of a solution by hand.
    decimals : int
        Most decimals of any number of the data and of the answer.
    long_numbers : tuple of int
        Least and most measurements that need all these decimals.
    chi_squared : tuple of Fraction
        Least and most of f^T Omega f at the answer: the measurements disagree, but not absurdly.
    zeros : int
        Measurements that may be 0.
    """

    n_poses: int
    loops: int
    products: int
    decimals: int
    long_numbers: tuple[int, int]
    chi_squared: tuple[Fraction, Fraction]
    zeros: int = 0

    def complaints(self, graph: ExactGraph, x1: tuple[Fraction, ...]) -> list[str]:
        """Say in a sentence each what of the band, or of a well-posed problem, does not hold.

        Parameters
        ----------
        graph : ExactGraph
            The data.
        x1 : tuple of Fraction
            The state after one step [m].

        Returns
        -------
        list of str
            Empty where the variant may be released.
        """
        found = [] if not any(graph.gradient(x1)) else ["x1 is not the solution: b(x1) is not zero."]
        try:
            start = graph.dead_reckoning()
        except ValueError as error:
            return [*found, f"The problem is not well-posed: {error}."]
        f = graph.residual(x1)
        variances = graph.edge_variances + graph.prior_variances
        used = sum(1 for r in f[: len(graph.edges)] if r)
        long = sum(1 for u in graph.measurements if not _ends(u, self.decimals - 1))
        chi_squared = sum((r * r / v for r, v in zip(f, variances, strict=True)), Fraction(0))
        corrections = {x - x0 for x, x0 in zip(x1, start, strict=True)} - {Fraction(0)}
        low, high = self.chi_squared
        rules = [
            (graph.n_poses == self.n_poses, f"{graph.n_poses} poses, expected {self.n_poses}"),
            (
                len(graph.edges) - graph.n_poses + 1 == self.loops,
                f"{len(graph.edges)} edges, expected {self.loops} loops",
            ),
            (used == self.products, f"{used} edges share a mismatch, expected {self.products}"),
            (
                all(_ends(value, self.decimals) for value in (*graph.measurements, *graph.prior_means, *x1, *start)),
                f"a number has more than {self.decimals} decimals",
            ),
            (
                self.long_numbers[0] <= long <= self.long_numbers[1],
                f"{long} measurements have {self.decimals} decimals, expected {self.long_numbers}",
            ),
            (
                low <= chi_squared <= high,
                f"chi-squared is {decimal(chi_squared)}, expected {decimal(low)} to {decimal(high)}",
            ),
            (
                all(r * r <= LARGEST_RESIDUAL * v for r, v in zip(f, variances, strict=True)),
                "a residual is beyond 3 sigma",
            ),
            (graph.measurements.count(Fraction(0)) <= self.zeros, "a measurement is 0"),
            (bool(corrections), "the step is 0"),
            (all(abs(value) <= LARGEST_STATE for value in (*x1, *start)), f"a pose is beyond {LARGEST_STATE} m"),
            (max(Counter(graph.edges).values()) == 1, "two measurements join the same poses"),
        ]
        return found + [f"{words}." for holds, words in rules if not holds]


def _ends(value: Fraction, decimals: int) -> bool:
    """Whether a number can be written with so many decimals."""
    return bool(10**decimals % value.denominator == 0)
