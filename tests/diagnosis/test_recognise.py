"""Answers are compared array by array or all at once, with the same outcome."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from autograder.diagnosis.recognise import CLOSE, _agree, _all_agree, laid_out

NUMBERS = st.sampled_from([0.0, 1.0, -2.5, 1e-9, 1.0 + 1e-10, 1.0 + 1e-6, 1e12, np.inf, -np.inf, np.nan])
SHAPES = st.sampled_from([(), (0,), (1,), (2,), (1, 2), (2, 1)])
ARRAYS = SHAPES.flatmap(
    lambda shape: st.lists(NUMBERS, min_size=int(np.prod(shape)), max_size=int(np.prod(shape))).map(
        lambda values: np.array(values, dtype=np.float64).reshape(shape)
    )
)
ANSWERS = st.one_of(st.none(), st.tuples(ARRAYS, ARRAYS))


@given(st.lists(st.tuples(ANSWERS, ANSWERS), min_size=1, max_size=4), st.lists(st.booleans(), min_size=4, max_size=4))
def test_all_at_once_agrees_as_one_by_one(pairs, equal) -> None:
    """Two answers agree as a whole where they agree call by call."""
    slips = [one for one, _ in pairs]
    students = [one if same else other for (one, other), same in zip(pairs, equal, strict=False)]
    each = all(_agree(one, other, CLOSE) for one, other in zip(slips, students, strict=True))
    assert _all_agree(laid_out(slips, 2), laid_out(students, 2), CLOSE) == each
