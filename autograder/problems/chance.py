"""What the strategies draw from: whole numbers between -99 and 99, and arrays of values from a table.

The bounds are more than taste: Hypothesis mixes larger literals that it finds in imported local
modules into its draws, so wider ranges would make the cases depend on where the grader is
installed. Larger and smaller numbers are made of these by tables and by scaling.

An array is one draw, of a few bytes: a draw for every number would take longer than grading.
"""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from functools import cache
from typing import Any

import numpy as np
from hypothesis import strategies as st
from hypothesis.strategies import DrawFn, SearchStrategy

# A strategy takes longer to make than to draw from, so each is made once.
integers = cache(st.integers)
sampled_from = cache(st.sampled_from)

booleans = st.booleans()


BYTES = 13  # of one draw; no literal of bytes in these packages has this length
_few = st.binary(min_size=BYTES, max_size=BYTES)


def _words(draw: DrawFn, count: int) -> np.ndarray:
    """Draw so many whole numbers from 0 to 65535: the bytes themselves, or what they are stretched to."""
    data = draw(_few)
    if 2 * count > BYTES:
        data = hashlib.shake_128(data).digest(2 * count)
    return np.frombuffer(data, dtype="<u2", count=count)


@cache
def between(low: int, high: int) -> np.ndarray:
    """Return the whole numbers of a range as a table, the simplest first: 0, 1, -1, 2 ...

    Examples
    --------
    >>> between(-2, 1)
    array([ 0.,  1., -1., -2.])
    """
    return np.array(sorted(range(low, high + 1), key=lambda value: (abs(value), value < 0)), dtype=np.float64)


def drawn(draw: DrawFn, table: Sequence[float] | np.ndarray, count: int) -> np.ndarray:
    """Draw an array of exactly so many values of a table, each as likely as any other; the first is the simplest."""
    values: np.ndarray = np.asarray(table, dtype=np.float64)[_words(draw, count) % len(table)]
    return values


def order(draw: DrawFn, count: int) -> list[int]:
    """Draw an order of so many things; as they stand is the simplest."""
    return [int(place) for place in np.argsort(_words(draw, count), kind="stable")]


def numbers(draw: DrawFn, elements: SearchStrategy[Any], count: int) -> np.ndarray:
    """Draw an array of exactly so many numbers, one by one: of these each can be made simpler by itself."""
    return np.array(draw(st.lists(elements, min_size=count, max_size=count)), dtype=np.float64)


def states_in_tenths(draw: DrawFn, n_poses: int) -> np.ndarray:
    """Draw a state in tenths of a metre, up to 9.9 m."""
    return drawn(draw, between(-99, 99), n_poses) / 10


def displacements(draw: DrawFn, count: int) -> np.ndarray:
    """Draw measurements in tenths of a metre, up to 3 m."""
    return drawn(draw, between(-30, 30), count) / 10


def nonzero(draw: DrawFn, count: int) -> np.ndarray:
    """Draw whole numbers from -9 to 9 without 0."""
    found = drawn(draw, between(-9, 8), count)
    return found + (found >= 0)
