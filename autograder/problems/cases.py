"""A case is the arguments of one call; cases are told apart by value and ordered from simple to rich."""

from __future__ import annotations

import hashlib
from typing import Any

import numpy as np

from assignment.posegraph import PoseGraph, Ranging

Case = tuple[Any, ...]
"""The arguments of one call: float64 arrays, pose graphs and rangings."""


def key(case: Case) -> bytes:
    """Identify a case by the bytes of its numbers."""
    parts = [repr(array.shape).encode() + array.tobytes() for argument in case for array in fields(argument)]
    return hashlib.sha256(b"|".join(parts)).digest()


def simplicity(case: Case) -> tuple[int, int, bytes]:
    """Order cases: fewer numbers first, then fewer digits."""
    numbers = [number for argument in case for array in fields(argument) for number in array.ravel().tolist()]
    return len(numbers), sum(len(f"{number:g}") for number in numbers), key(case)


def fields(argument: Any) -> tuple[np.ndarray, ...]:
    """Return the arrays that make up an argument: itself, or the fields of a pose graph or a ranging.

    Examples
    --------
    >>> [array.tolist() for array in fields(PoseGraph(2, [(0, 1)], [1], [4], [0], [0], [1]))]
    [2, [[0, 1]], [1.0], [4.0], [0], [0.0], [1.0]]
    """
    if isinstance(argument, Ranging):
        return (argument.beacon, argument.poses, argument.ranges, argument.variances)
    if not isinstance(argument, PoseGraph):
        return (argument,)
    return (
        np.array(argument.n_poses),
        argument.edges,
        argument.measurements,
        argument.edge_variances,
        argument.priors,
        argument.prior_means,
        argument.prior_variances,
    )
