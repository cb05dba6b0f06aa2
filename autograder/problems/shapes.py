"""Shapes of pose graphs in all their generality: trees, stars, several parts, lonely poses, loops, many priors.

A shape is worked out of numbers between 0 and 1, wherever they come from, so that the fixed core and
the drawn cases have the same kinds of graphs, and one of a hundred poses costs no more draws than a small one.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Shape:
    """Which poses the factors touch.

    Attributes
    ----------
    n_poses : int
    pairs : (k, 2) int array
        The edges.
    priors : (p,) int array
        The poses that carry a prior; one in every connected part at the least.
    """

    n_poses: int
    pairs: np.ndarray
    priors: np.ndarray


def numbers_needed(n_poses: int, loops: int, more_priors: int) -> int:
    """Return how many numbers `shaped` reads."""
    return 3 * n_poses + 2 * loops + 2 * more_priors


def shaped(n_poses: int, parts: int, loops: int, more_priors: int, chance: np.ndarray, star: bool = False) -> Shape:
    """Work out a shape: a forest, closed to loops, its edges turned and shuffled, priors in any order.

    Parameters
    ----------
    n_poses : int
        Number of poses.
    parts : int
        Number of connected parts, each with a prior; some may be one lonely pose.
    loops : int
        Edges beyond the forest, each from a pose to the one before the one before it, or, where
        there is none, beside an edge that is there.
    more_priors : int
        Priors beyond the first of each part, on any poses, also several on one.
    chance : (numbers_needed(...),) float array
        Numbers in [0, 1) that decide.
    star : bool
        Whether every pose hangs on the first one of its part, instead of on any earlier one.

    Examples
    --------
    >>> found = shaped(5, 2, 1, 1, np.linspace(0.9, 0.0, 19), star=True)
    >>> found.pairs.tolist(), found.priors.tolist()
    ([[4, 2], [0, 4], [3, 1], [2, 4]], [4, 4, 3])
    """
    name = np.argsort(chance[:n_poses], kind="stable")
    hangs, turns, rest = np.split(chance[n_poses:], [n_poses, 2 * n_poses + loops])
    parent = [-1] * parts
    for i in range(parts, n_poses):
        parent.append(i % parts if star else int(hangs[i] * i))
    pairs = [(parent[i], i) for i in range(parts, n_poses)]
    for at in (parts + rest[:loops] * (n_poses - parts)).astype(int).tolist():
        before = parent[at]
        pairs.append((parent[before] if parent[before] >= 0 else before, at))
    keys = turns[: len(pairs)]
    turned = np.array([pair[::-1] if int(99 * key) % 2 else pair for pair, key in zip(pairs, keys, strict=True)])
    where, keys = np.split(rest[loops:][: 2 * more_priors], [more_priors])
    priors = np.concatenate([np.arange(parts), (where * n_poses).astype(int)])
    order = np.argsort(np.concatenate([np.full(parts, 0.5), keys]), kind="stable")
    return Shape(n_poses, name[turned[np.argsort(turns[: len(pairs)], kind="stable")]], name[priors[order]])
