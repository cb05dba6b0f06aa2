"""Hypothesis strategies that draw further cases for every rung of the ladders.

All numbers come from integers between -99 and 99. This is more than taste: Hypothesis mixes larger
literals that it finds in imported local modules into its draws, so wider ranges would make the
cases depend on where the grader is installed.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from hypothesis import assume
from hypothesis import strategies as st
from hypothesis.strategies import DrawFn, SearchStrategy

from assignment.posegraph import PoseGraph, Ranging
from autograder.problems.cases import Case
from autograder.problems.core import jitter
from autograder.problems.graphs import MAX_CONDITION, information

VARIANCES = (0.01, 0.02, 0.04, 0.05, 0.1)
DECADES = (0.002, 0.01, 0.05, 0.2, 1.0, 5.0, 20.0)
WEIGHTS = (3.0, 7.0, 9.0, 11.0, 13.0, 21.0)  # the information of no graph of the other ladders
WEIGHT_DECADES = (0.03, 0.7, 3.0, 70.0, 300.0)

# A strategy takes longer to make than to draw from, so each is made once.
integers = cache(st.integers)
sampled_from = cache(st.sampled_from)

tenths = st.integers(-99, 99).map(lambda k: k / 10)
displacements = st.integers(-30, 30).map(lambda k: k / 10)
steps = st.integers(-9, 9).filter(bool).map(float)


_booleans = st.booleans()


@cache
def _states(n_poses: int) -> SearchStrategy[np.ndarray]:
    return st.lists(tenths, min_size=n_poses, max_size=n_poses).map(np.array)


@cache
def several(elements: SearchStrategy[Any], count: int) -> SearchStrategy[list[Any]]:
    """Draw a list of exactly so many elements."""
    return st.lists(elements, min_size=count, max_size=count)


@cache
def _orders(count: int) -> SearchStrategy[list[int]]:
    return st.permutations(range(count))


def chain(n_poses: int) -> list[tuple[int, int]]:
    """Return the pairs of a walk 0 -> 1 -> ... ."""
    return [(i, i + 1) for i in range(n_poses - 1)]


def _pair(draw: DrawFn, n_poses: int) -> tuple[int, int]:
    i = draw(integers(0, n_poses - 1))
    return i, (i + draw(integers(1, n_poses - 1))) % n_poses


def _measured(
    draw: DrawFn, n_poses: int, pairs: list[tuple[int, int]], variances: tuple[float, ...], priors: list[int]
) -> PoseGraph:
    k, p = len(pairs), len(priors)
    first_is_origin = priors == [0]
    measurements = numbers(draw, displacements, k)
    edge_variances = numbers(draw, sampled_from(variances), k)
    means = np.zeros(1) if first_is_origin else numbers(draw, displacements, p)
    prior_variances = numbers(draw, sampled_from((0.001, *variances)), p)
    return PoseGraph(n_poses, np.array(pairs), measurements, edge_variances, np.array(priors), means, prior_variances)


def numbers(draw: DrawFn, elements: SearchStrategy[float], count: int) -> np.ndarray:
    """Draw an array of exactly so many numbers."""
    return np.array(draw(several(elements, count)))


@st.composite
def single_loops(draw: DrawFn) -> Case:
    """Draw a walk of 2 to 6 poses with one loop closure from the first to the last."""
    n = draw(integers(2, 6))
    graph = _measured(draw, n, [*chain(n), (0, n - 1)], VARIANCES, [0])
    return draw(_states(n)), graph


def _tangled(draw: DrawFn, low: int, high: int) -> tuple[int, list[tuple[int, int]]]:
    n = draw(integers(low, high))
    pairs = chain(n) + [_pair(draw, n) for _ in range(draw(integers(1, 3)))]
    turned = draw(several(_booleans, len(pairs)))
    pairs = [(j, i) if turn else (i, j) for (i, j), turn in zip(pairs, turned, strict=True)]
    return n, [pairs[place] for place in draw(_orders(len(pairs)))]


@st.composite
def several_loops(draw: DrawFn) -> Case:
    """Draw a walk with one to three more edges anywhere, some backward, in any order."""
    n, pairs = _tangled(draw, 3, 6)
    return draw(_states(n)), _measured(draw, n, pairs, VARIANCES, [0])


def _prior_poses(draw: DrawFn, n_poses: int) -> list[int]:
    return draw(several(integers(0, n_poses - 1), draw(integers(1, 2))))


@st.composite
def priors(draw: DrawFn) -> Case:
    """Draw a graph whose one or two priors stand on any pose, with any mean."""
    n, pairs = _tangled(draw, 2, 5)
    return draw(_states(n)), _measured(draw, n, pairs, VARIANCES, _prior_poses(draw, n))


@st.composite
def variances(draw: DrawFn) -> Case:
    """Draw a graph with variances from 0.002 to 20 m^2."""
    n, pairs = _tangled(draw, 2, 5)
    graph = _measured(draw, n, pairs, DECADES, _prior_poses(draw, n))
    assume(np.linalg.cond(information(graph)) <= MAX_CONDITION)
    return draw(_states(n)), graph


@st.composite
def real_valued(draw: DrawFn) -> Case:
    """Draw a graph and a state, then make every number irregular in all its digits."""
    n, pairs = _tangled(draw, 2, 6)
    plain = _measured(draw, n, pairs, VARIANCES, _prior_poses(draw, n))
    salt = draw(integers(0, 99)) / 99
    k, p = len(plain.edges), len(plain.priors)
    graph = PoseGraph(
        n,
        plain.edges,
        plain.measurements + jitter(k, salt),
        plain.edge_variances * (1.2 + jitter(k, salt)),
        plain.priors,
        plain.prior_means + jitter(p, salt + 0.3),
        plain.prior_variances * (1.2 + jitter(p, salt + 0.3)),
    )
    return 9.0 * draw(_states(n)) + jitter(n, salt + 0.6), graph


def system(J: np.ndarray, weights: np.ndarray, f: np.ndarray) -> Case:
    """Make a case of J, Omega and f from the diagonal of Omega."""
    return J, np.diag(weights), f


def _whole(draw: DrawFn, shape: tuple[int, int]) -> np.ndarray:
    return np.array(draw(several(integers(-9, 9), shape[0] * shape[1])), dtype=np.float64).reshape(shape)


@st.composite
def whole_numbers(draw: DrawFn) -> Case:
    """Draw small J, Omega and f of whole numbers."""
    m, n = draw(integers(2, 4)), draw(integers(2, 3))
    weights = draw(several(sampled_from(WEIGHTS), m))
    return system(_whole(draw, (m, n)), np.array(weights), np.array(draw(several(steps, m))))


@st.composite
def unequal_weights(draw: DrawFn) -> Case:
    """Draw whole numbers with weights over four decades."""
    m, n = draw(integers(2, 5)), draw(integers(2, 4))
    weights = draw(several(sampled_from(WEIGHT_DECADES), m))
    return system(_whole(draw, (m, n)), np.array(weights), np.array(draw(several(steps, m))))


@st.composite
def graph_shaped(draw: DrawFn) -> Case:
    """Draw a J with two opposite entries in a row, on more poses than the graphs of the other ladders."""
    n = draw(integers(7, 9))
    m = n + draw(integers(1, 3))
    J = np.zeros((m, n))
    for row in range(m - 1):
        i, j = _pair(draw, n)
        J[row, i], J[row, j] = 1.0, -1.0
    J[m - 1, draw(integers(0, n - 1))] = 1.0
    weights = draw(several(sampled_from(WEIGHTS), m))
    return system(J, np.array(weights), np.array(draw(several(tenths, m))) + 0.01)


@st.composite
def dense(draw: DrawFn) -> Case:
    """Draw J and f irregular in all their digits."""
    m, n = draw(integers(3, 7)), draw(integers(2, 5))
    salt = draw(integers(0, 99)) / 99
    J = _whole(draw, (m, n)) + jitter(m * n, salt).reshape(m, n)
    weights = np.array(draw(several(sampled_from(WEIGHTS), m))) * (1.2 + jitter(m, salt))
    return system(J, weights, np.array(draw(several(tenths, m))) + jitter(m, salt + 0.4))


@st.composite
def full_loops(draw: DrawFn) -> Case:
    """Draw a loop through all poses, and two states to start from."""
    n = draw(integers(2, 5))
    graph = _measured(draw, n, [*chain(n), (0, n - 1)], VARIANCES, [0])
    return _two_states(draw, n), graph


@st.composite
def loops_in_graphs(draw: DrawFn) -> Case:
    """Draw a walk of which a part closes to a loop, edges turned and shuffled, the prior anywhere."""
    n = draw(integers(3, 6))
    i = draw(integers(0, n - 2))
    j = draw(integers(i + 1, min(n - 1, i + 3)))
    pairs = [*chain(n), (i, j)]
    turned = draw(several(_booleans, len(pairs)))
    pairs = [(b, a) if turn else (a, b) for (a, b), turn in zip(pairs, turned, strict=True)]
    pairs = [pairs[place] for place in draw(_orders(len(pairs)))]
    graph = _measured(draw, n, pairs, VARIANCES, [draw(integers(0, n - 1))])
    return _two_states(draw, n), graph


def _two_states(draw: DrawFn, n_poses: int) -> np.ndarray:
    first, second = draw(_states(n_poses)), draw(_states(n_poses))
    assume(np.abs(first - second).max() >= 1.0)
    return np.array([first, second])


@st.composite
def rangings(draw: DrawFn, exact: bool = False) -> Case:
    """Draw a state and ranges to a beacon anywhere but on the line; whole numbers where `exact`."""
    n = draw(integers(2, 3 if exact else 6))
    q = draw(integers(1, 2 if exact else 4))
    beacon = np.array([float(draw(integers(-9, 9))), float(draw(steps))])
    poses = np.array(draw(several(integers(0, n - 1), q)))
    ranges = np.array(draw(several(integers(0, 99), q))) / (1.0 if exact else 10.0)
    salt = 0.0 if exact else draw(integers(0, 99)) / 99
    shift = np.zeros(n) if exact else jitter(n, salt)
    x = np.array(draw(several(integers(-9, 9), n)), dtype=np.float64) + shift
    return x, Ranging(beacon, poses, ranges, np.full(q, 0.01))


STRATEGIES: dict[str, dict[str, SearchStrategy[Case]]] = {
    "graphs": {
        "single_loops": single_loops(),
        "several_loops": several_loops(),
        "priors": priors(),
        "variances": variances(),
        "real_valued": real_valued(),
    },
    "matrices": {
        "whole_numbers": whole_numbers(),
        "unequal_weights": unequal_weights(),
        "graph_shaped": graph_shaped(),
        "dense": dense(),
    },
    "loops": {"single_loops": full_loops(), "loops_in_graphs": loops_in_graphs()},
    "rangings": {"distances": rangings(), "derivatives": rangings()},
}
