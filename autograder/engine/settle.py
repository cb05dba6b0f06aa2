"""Leave out of a number what the processor decides: two machines that compute the same thing write the same."""

from __future__ import annotations

from typing import Any

import numpy as np

from autograder.stages.base import Array


def settled(values: Any, digits: int = 10, noise: float = 1e-12) -> Array:
    """Round to a number of significant digits, and what is noise beside the largest to 0.

    Parameters
    ----------
    values : array_like of float
        Of any shape, nan and inf among them.
    digits : int
        Significant digits that are kept.
    noise : float
        What is smaller than this, or than this part of the largest value, is 0.

    Returns
    -------
    ndarray of float64, of the same shape
        nan and inf stay; -0. becomes 0.

    Examples
    --------
    >>> settled([0.1 + 0.2, 3e-17, -0.0, np.inf]).tolist()
    [0.3, 0.0, 0.0, inf]
    >>> settled([1234567.0, 0.12345678], digits=6).tolist(), settled(0.5).tolist()
    ([1234570.0, 0.123457], 0.5)
    """
    values = np.asarray(values, dtype=np.float64)
    finite = np.where(np.isfinite(values), values, 0.0)
    size = np.abs(finite)
    place = digits - 1 - np.floor(np.log10(np.maximum(size, 1e-290)))
    up, down = 10.0 ** np.clip(place, 0, 300), 10.0 ** np.clip(-place, 0, 300)  # powers of ten are exact upwards only
    with np.errstate(over="ignore"):  # the largest number of all, rounded up
        rounded = np.round(finite * up / down) * down / up
    rounded = np.where(size < noise * max(1.0, size.max(initial=0.0)), 0.0, rounded)
    return np.asarray(np.where(np.isfinite(values), rounded, values) + 0.0)
