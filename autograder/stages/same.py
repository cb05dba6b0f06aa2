"""The one comparison of numbers: the same, different, or nothing that can be compared.

A verdict may say `not |got - wanted| <= within`: nan is then wrong, as it should be. A sentence must not: that nan
is not within a tolerance does not show that a function forgets, or moves, or turns a sign. Hence two questions,
and both are answered no where an array is missing, has another shape, or holds a value that is not finite.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def finite(*arrays: Array | None) -> bool:
    """Whether all arrays are there and hold nothing but finite numbers.

    Examples
    --------
    >>> finite(np.ones(2)), finite(np.ones(2), np.array(np.inf)), finite(None)
    (True, False, False)
    """
    return all(each is not None and bool(np.isfinite(each).all()) for each in arrays)


def same(one: Array | None, other: Array | None, within: Array | float) -> bool:
    """Whether two arrays can be compared and no two of their numbers are further apart than `within`.

    Parameters
    ----------
    one, other : float array or None
        Of any shape, () included; None where a call gave no numbers.
    within : float or float array
        Absolute tolerance, one for all or one for each number.

    Examples
    --------
    >>> same(np.ones(2), np.ones(2) + 1e-9, 1e-6), same(np.ones(2), np.ones((2, 1)), 1e-6)
    (True, False)
    >>> same(np.array([np.nan]), np.array([np.nan]), 1e-6)
    False
    """
    return _compared(one, other, within) is True


def different(one: Array | None, other: Array | None, within: Array | float) -> bool:
    """Whether two arrays can be compared and two of their numbers are further apart than `within`.

    Examples
    --------
    >>> different(np.zeros(2), np.array([0.0, 1.0]), 0.5)
    True
    >>> different(np.zeros(2), np.array([0.0, np.nan]), 0.5), different(np.zeros(2), np.zeros(3), 0.5)
    (False, False)
    """
    return _compared(one, other, within) is False


def off(got: Array, wanted: Array, within: Array | float) -> NDArray[np.bool_]:
    """Mark the numbers that are further off than `within`; one that is not finite is off.

    Examples
    --------
    >>> off(np.array([1.0, 2.0, np.nan]), np.array([1.0, 2.5, 3.0]), 0.1).tolist()
    [False, True, True]
    """
    with np.errstate(invalid="ignore", over="ignore"):
        return np.asarray(~(np.abs(got - wanted) <= within))


def _compared(one: Array | None, other: Array | None, within: Array | float) -> bool | None:
    """Whether all numbers are within; None where there is nothing to compare."""
    if one is None or other is None or one.shape != other.shape or not finite(one, other):
        return None
    return not off(one, other, within).any()
