"""Slips of `residual` that lose digits: the formula is right, the numbers are not."""
# ruff: noqa: D401 - the docstring of a slip states what is wrong

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from autograder.stages.slips.catalogue import Catalogue
from autograder.stages.slips.patterns import residual_sizes, rounded, single_precision
from reference_solution import slam1d as right

if TYPE_CHECKING:
    from assignment.posegraph import PoseGraph

slip = Catalogue()


@slip("R14, R15", pattern=rounded(right.residual, residual_sizes))
def residual_rounded(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The residual is rounded.

    A few decimals look like enough on paper; a computer keeps sixteen, and the steps that follow need them.
    """
    return np.round(right.residual(x, graph), 4)


@slip()
def residual_in_whole_numbers(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The residual is stored in an array of integers, which cuts the decimals off.

    An array keeps the type it was made with; which type does yours have, and what happens to 0.5 in it?
    """
    return right.residual(x, graph).astype(int)


@slip("S24", pattern=single_precision(right.residual, residual_sizes, terms=4))
def residual_in_single_precision(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The residual is worked out in single precision.

    Half of the digits are gone before anything is solved; what type do your arrays have?
    """
    i, j = graph.edges.T
    x = x.astype(np.float32)
    between = x[i] + graph.measurements.astype(np.float32) - x[j]
    return np.concatenate([between, x[graph.priors] - graph.prior_means.astype(np.float32)])


LOST_DIGITS = slip.entries
