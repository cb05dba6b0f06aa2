"""What the strategies draw from: whole numbers between -99 and 99, and arrays of them.

The bounds are more than taste: Hypothesis mixes larger literals that it finds in imported local
modules into its draws, so wider ranges would make the cases depend on where the grader is
installed. Larger and smaller numbers are made of these by tables and by scaling.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from hypothesis import strategies as st
from hypothesis.strategies import DrawFn, SearchStrategy

# A strategy takes longer to make than to draw from, so each is made once.
integers = cache(st.integers)
sampled_from = cache(st.sampled_from)

booleans = st.booleans()


@cache
def several(elements: SearchStrategy[Any], count: int) -> SearchStrategy[list[Any]]:
    """Draw a list of exactly so many elements."""
    return st.lists(elements, min_size=count, max_size=count)


@cache
def orders(count: int) -> SearchStrategy[list[int]]:
    """Draw an order of so many things."""
    return st.permutations(range(count))


def numbers(draw: DrawFn, elements: SearchStrategy[Any], count: int) -> np.ndarray:
    """Draw an array of exactly so many numbers."""
    return np.array(draw(several(elements, count)), dtype=np.float64)


# Whole numbers are drawn and turned into others as arrays: a strategy that maps each costs twice as much.
def states_in_tenths(draw: DrawFn, n_poses: int) -> np.ndarray:
    """Draw a state in tenths of a metre, up to 9.9 m."""
    return numbers(draw, integers(-99, 99), n_poses) / 10


def displacements(draw: DrawFn, count: int) -> np.ndarray:
    """Draw measurements in tenths of a metre, up to 3 m."""
    return numbers(draw, integers(-30, 30), count) / 10


def nonzero(draw: DrawFn, count: int) -> np.ndarray:
    """Draw whole numbers from -9 to 9 without 0."""
    drawn = numbers(draw, integers(-9, 8), count)
    return drawn + (drawn >= 0)
