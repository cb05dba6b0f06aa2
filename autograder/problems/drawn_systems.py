"""Hypothesis strategies for what is no graph: J, Omega and f as matrices, and ranges to a beacon."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st
from hypothesis.strategies import DrawFn

from assignment.posegraph import Ranging
from autograder.problems.cases import Case
from autograder.problems.chance import between, drawn, integers, nonzero, sampled_from
from autograder.problems.irregular import jitter

WEIGHTS = (3.0, 7.0, 9.0, 11.0, 13.0, 21.0)  # the information of no graph of the other ladders
WEIGHT_DECADES = (0.0012, 0.03, 0.7, 3.0, 70.0, 300.0, 3000.0, 90000.0)
SIZES = (0.004, 1.0, 9.0, 95.0)  # of f, times up to 10.4 m
NEAR_AND_FAR = (1.0, 1.0, 9.9)  # of the line, times up to 9 m


def system(J: np.ndarray, weights: np.ndarray, f: np.ndarray) -> Case:
    """Make a case of J, Omega and f from the diagonal of Omega."""
    return J, np.diag(weights), f


def _whole(draw: DrawFn, shape: tuple[int, int]) -> np.ndarray:
    """Draw a matrix of whole numbers whose first is not 0: one of zeros alone could be a residual, too."""
    first = nonzero(draw, 1)
    return np.append(first, drawn(draw, between(-9, 9), shape[0] * shape[1] - 1)).reshape(shape)


@st.composite
def whole_numbers(draw: DrawFn) -> Case:
    """Draw small J, Omega and f of whole numbers."""
    m, n = draw(integers(2, 4)), draw(integers(2, 3))
    weights = drawn(draw, WEIGHTS, m)
    return system(_whole(draw, (m, n)), weights, nonzero(draw, m))


@st.composite
def unequal_weights(draw: DrawFn) -> Case:
    """Draw whole numbers with weights over eight decades."""
    m, n = draw(integers(2, 5)), draw(integers(2, 4))
    weights = drawn(draw, WEIGHT_DECADES, m)
    return system(_whole(draw, (m, n)), weights, nonzero(draw, m))


@st.composite
def graph_shaped(draw: DrawFn) -> Case:
    """Draw a J with two opposite entries in a row but the first, which has one: a graph's priors stand last."""
    n = draw(sampled_from((7, 8, 9, 11)))
    m = n + draw(integers(1, 3))
    ends = drawn(draw, between(0, 98), 2 * m).astype(int)
    i, rows = ends[:m] % n, np.arange(m)
    J = np.zeros((m, n))
    J[rows, i], J[rows, (i + 1 + ends[m:] % (n - 1)) % n] = 1.0, -1.0
    J[0] = np.arange(n) == i[0]
    weights = drawn(draw, WEIGHTS, m)
    return system(J, weights, drawn(draw, between(-99, 99), m) / 10 + 0.01)


@st.composite
def dense(draw: DrawFn) -> Case:
    """Draw J and f irregular in all their digits; f small or large, J with more rows than columns or with fewer."""
    m, n = draw(integers(2, 7)), draw(integers(2, 5))
    salt = draw(integers(0, 99)) / 99
    J = _whole(draw, (m, n)) + jitter(m * n, salt).reshape(m, n)
    weights = drawn(draw, WEIGHTS, m) * (1.2 + jitter(m, salt))
    f = drawn(draw, between(-99, 99), m) / 10 + jitter(m, salt + 0.4)
    return system(J, weights, draw(sampled_from(SIZES)) * f)


@st.composite
def rangings(draw: DrawFn, exact: bool = False) -> Case:
    """Draw a state and ranges to a beacon anywhere but on the line, also far; small whole numbers where `exact`."""
    n = draw(integers(2, 3) if exact else sampled_from((2, 3, 4, 5, 6, 12)))
    q = draw(integers(1, 2 if exact else 4))
    beacon = np.array([float(draw(integers(-9, 9))), nonzero(draw, 1)[0]])
    poses = drawn(draw, between(0, n - 1), q).astype(int)
    ranges, x = drawn(draw, between(0, 99), q), drawn(draw, between(-9, 9), n)
    if not exact:
        salt, sizes = draw(integers(0, 99)) / 99, drawn(draw, NEAR_AND_FAR, 3)
        beacon, ranges, x = beacon * sizes[:2], ranges * sizes[2] / 10, x * sizes[2] + jitter(n, salt)
    return x, Ranging(beacon, poses, ranges, np.full(q, 0.01))
