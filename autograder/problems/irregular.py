"""Irregular digits that are the same on every machine, with no random generator: multiples of the golden ratio."""

from __future__ import annotations

import numpy as np

GOLDEN = 0.6180339887498949


def jitter(count: int, salt: float = 0.0) -> np.ndarray:
    """Spread `count` irregular numbers over (-0.5, 0.5).

    Examples
    --------
    >>> jitter(3).round(3)
    array([ 0.118, -0.264,  0.354])
    """
    return (np.arange(1, count + 1) * GOLDEN + salt) % 1.0 - 0.5


def scatter(count: int, salt: float = 0.0) -> np.ndarray:
    """Throw `count` numbers into [0, 1): by squares, so that no pattern of one and the next is left.

    Examples
    --------
    >>> scatter(4).round(3)
    array([0.618, 0.472, 0.562, 0.889])
    """
    places = np.arange(1, count + 1) + 97.0 * salt
    return places * places * GOLDEN % 1.0
