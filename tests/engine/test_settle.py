"""What is written of a number does not depend on its last bits."""

from __future__ import annotations

from decimal import Decimal

import numpy as np
from hypothesis import example, given
from hypothesis import strategies as st

from autograder.engine.settle import settled

LISTS = st.lists(st.floats(), max_size=6)


@given(LISTS)
@example([1.7976931348623157e308])
@example([5e-324])
def test_what_is_written_is_near_and_stays(values: list[float]) -> None:
    """Rounding moves a number by less than 1e-9 of it, or by noise beside the largest; twice is once."""
    given_, found = np.array(values, dtype=np.float64), settled(values)
    finite = np.isfinite(given_) & np.isfinite(found)
    largest = np.abs(given_[np.isfinite(given_)]).max(initial=1.0)
    assert found.shape == given_.shape
    assert np.array_equal(found[~np.isfinite(given_)], given_[~np.isfinite(given_)], equal_nan=True)
    given_, after = given_[finite], found[finite]
    assert (np.abs(after - given_) <= np.maximum(1e-9 * np.abs(given_), 1e-12 * largest)).all()
    assert np.array_equal(settled(found), found, equal_nan=True)


@given(st.lists(st.tuples(st.decimals(-1000, 1000, places=3), st.sampled_from([-3, -1, 0, 2])), min_size=1, max_size=6))
def test_the_last_bits_do_not_count(values: list[tuple[Decimal, int]]) -> None:
    """Numbers of a few decimals come out as they are typed, whichever way a kernel rounded them."""
    typed = np.array([float(value) for value, _ in values])
    bits = np.array([float(number) for _, number in values])
    assert settled(typed * (1 + bits * 2.0**-52)).tolist() == (typed + 0.0).tolist()
