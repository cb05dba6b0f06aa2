"""Equivalent conventions: rows in another order, rows with the sign turned, the same least squares.

Judged for all cases at once: on every case there must be one signed permutation of the rows that
turns the student's f, J and Omega into the expected ones.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from autograder.stages.base import Array

CLOSE = 1e-7


@dataclass(frozen=True)
class Convention:
    """Which liberties a student took, over all cases."""

    reordered: bool
    turned: bool

    @property
    def remark(self) -> str:
        """Say so, kindly."""
        what = {
            (True, False): "the rows stand in another order than edges, then priors",
            (False, True): "some rows of f and J have the opposite sign",
            (True, True): "the rows stand in another order, and some have the opposite sign",
        }[(self.reordered, self.turned)]
        return f"f, J and Omega fit together but {what}: an equivalent convention, accepted."


@dataclass(frozen=True)
class Rows:
    """f, J and Omega of one case."""

    f: Array
    J: Array
    omega: Array


def convention(pairs: Iterable[tuple[Rows | None, Rows]]) -> Convention | None:
    """Find the convention that explains all cases, each given and expected; None where there is none.

    None as well where nothing differs. The first case without a match ends the search, as does one
    of which nothing usable was given.
    """
    reordered = turned = False
    for one, other in pairs:
        match = None if one is None else _match(one, other)
        if match is None:
            return None
        order, signs = match
        reordered |= bool((order != np.arange(len(order))).any())
        turned |= bool((signs < 0).any())
    return Convention(reordered, turned) if reordered or turned else None


def whitened(pairs: Iterable[tuple[Rows | None, Rows]]) -> bool:
    """Whether in all cases, each given and expected, f and J are divided by the standard deviations and Omega is I.

    The order of the rows and their signs do not matter: H, b and the step are the right ones.
    """
    for one, other in pairs:
        root = np.sqrt(np.diag(other.omega))
        white = Rows(root * other.f, root[:, None] * other.J, np.eye(len(root)))
        if one is None or _match(one, white) is None:
            return False
    return True


def rows_alike(one: Array, other: Array, within: float) -> bool:
    """Whether two arrays hold the same rows, in whatever order; a row of numbers or a single number each.

    Examples
    --------
    >>> rows_alike(np.array([1.0, 2.0, 2.0]), np.array([2.0, 1.0, 2.0]), 1e-6)
    True
    >>> rows_alike(np.array([1.0, 1.0, 2.0]), np.array([2.0, 1.0, 2.0]), 1e-6)
    False
    """
    free = list(other)
    for row in one:
        found = next((place for place, each in enumerate(free) if (np.abs(each - row) <= within).all()), None)
        if found is None:
            return False
        del free[found]
    return not free


def _match(given: Rows, expected: Rows) -> tuple[Array, Array] | None:
    """Pair every row of the student's with one of the expected rows, up to its sign."""
    m = len(expected.f)
    weights, wanted = np.diag(given.omega), np.diag(expected.omega)
    beside = given.omega - np.diag(weights)
    if not np.abs(beside).max(initial=0.0) <= CLOSE * np.abs(wanted).max(initial=0.0):
        return None
    mine = np.column_stack([given.J, given.f])
    right = np.column_stack([expected.J, expected.f])
    allowed = CLOSE * (1.0 + np.abs(right).max(axis=1))
    close_weights = np.abs(weights[:, None] - wanted) <= CLOSE * wanted
    order, signs = np.full(m, -1), np.ones(m)
    free = np.ones(m, dtype=bool)
    for row in range(m):
        plus = (np.abs(mine[row] - right) <= allowed[:, None]).all(axis=1)
        minus = (np.abs(mine[row] + right) <= allowed[:, None]).all(axis=1)
        fitting = (plus | minus) & close_weights[row] & free
        if not fitting.any():
            return None
        # A row that is neither moved nor turned is preferred, then one that is not turned: where rows
        # are equal, or opposite, a student is not told of a liberty that was not taken.
        unturned = fitting & plus
        choice = unturned if unturned.any() else fitting
        partner = row if choice[row] else int(np.argmax(choice))
        order[row], signs[row], free[partner] = partner, 1.0 if plus[partner] else -1.0, False
    return order, signs
