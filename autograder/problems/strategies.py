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
from autograder.problems.graphs import MAX_CONDITION, information, loop_edges, nudged

VARIANCES = (0.01, 0.02, 0.04, 0.05, 0.1)
DECADES = (0.002, 0.01, 0.05, 0.2, 1.0, 5.0, 20.0)
WEIGHTS = (3.0, 7.0, 9.0, 11.0, 13.0, 21.0)  # the information of no graph of the other ladders
WEIGHT_DECADES = (0.03, 0.7, 3.0, 70.0, 300.0)

# A strategy takes longer to make than to draw from, so each is made once.
integers = cache(st.integers)
sampled_from = cache(st.sampled_from)

_booleans = st.booleans()


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
    measurements = _displacements(draw, k)
    edge_variances = numbers(draw, sampled_from(variances), k)
    means = np.zeros(1) if first_is_origin else _displacements(draw, p)
    prior_variances = numbers(draw, sampled_from((0.001, *variances)), p)
    return PoseGraph(n_poses, np.array(pairs), measurements, edge_variances, np.array(priors), means, prior_variances)


def numbers(draw: DrawFn, elements: SearchStrategy[Any], count: int) -> np.ndarray:
    """Draw an array of exactly so many numbers."""
    return np.array(draw(several(elements, count)), dtype=np.float64)


# Whole numbers are drawn and turned into others as arrays: a strategy that maps each costs twice as much.
def _states(draw: DrawFn, n_poses: int) -> np.ndarray:
    """Draw a state in tenths of a metre, up to 9.9 m."""
    return numbers(draw, integers(-99, 99), n_poses) / 10


def _displacements(draw: DrawFn, count: int) -> np.ndarray:
    """Draw measurements in tenths of a metre, up to 3 m."""
    return numbers(draw, integers(-30, 30), count) / 10


def _nonzero(draw: DrawFn, count: int) -> np.ndarray:
    """Draw whole numbers from -9 to 9 without 0."""
    drawn = numbers(draw, integers(-9, 8), count)
    return drawn + (drawn >= 0)


@st.composite
def single_loops(draw: DrawFn) -> Case:
    """Draw a walk of 2 to 6 poses with one loop closure from the first to the last."""
    n = draw(integers(2, 6))
    graph = _measured(draw, n, [*chain(n), (0, n - 1)], VARIANCES, [0])
    return _states(draw, n), graph


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
    return _states(draw, n), _measured(draw, n, pairs, VARIANCES, [0])


def _prior_poses(draw: DrawFn, n_poses: int) -> list[int]:
    return draw(several(integers(0, n_poses - 1), draw(integers(1, 2))))


@st.composite
def priors(draw: DrawFn) -> Case:
    """Draw a graph whose one or two priors stand on any pose, with any mean."""
    n, pairs = _tangled(draw, 2, 5)
    return _states(draw, n), _measured(draw, n, pairs, VARIANCES, _prior_poses(draw, n))


@st.composite
def variances(draw: DrawFn) -> Case:
    """Draw a graph with variances from 0.002 to 20 m^2."""
    n, pairs = _tangled(draw, 2, 5)
    graph = _measured(draw, n, pairs, DECADES, _prior_poses(draw, n))
    assume(np.linalg.cond(information(graph)) <= MAX_CONDITION)
    return _states(draw, n), graph


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
    return 9.0 * _states(draw, n) + jitter(n, salt + 0.6), graph


def system(J: np.ndarray, weights: np.ndarray, f: np.ndarray) -> Case:
    """Make a case of J, Omega and f from the diagonal of Omega."""
    return J, np.diag(weights), f


def _whole(draw: DrawFn, shape: tuple[int, int]) -> np.ndarray:
    """Draw a matrix of whole numbers whose first is not 0: one of zeros alone could be a residual, too."""
    first = _nonzero(draw, 1)
    return np.append(first, numbers(draw, integers(-9, 9), shape[0] * shape[1] - 1)).reshape(shape)


@st.composite
def whole_numbers(draw: DrawFn) -> Case:
    """Draw small J, Omega and f of whole numbers."""
    m, n = draw(integers(2, 4)), draw(integers(2, 3))
    weights = numbers(draw, sampled_from(WEIGHTS), m)
    return system(_whole(draw, (m, n)), weights, _nonzero(draw, m))


@st.composite
def unequal_weights(draw: DrawFn) -> Case:
    """Draw whole numbers with weights over four decades."""
    m, n = draw(integers(2, 5)), draw(integers(2, 4))
    weights = numbers(draw, sampled_from(WEIGHT_DECADES), m)
    return system(_whole(draw, (m, n)), weights, _nonzero(draw, m))


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
    weights = numbers(draw, sampled_from(WEIGHTS), m)
    return system(J, weights, numbers(draw, integers(-99, 99), m) / 10 + 0.01)


@st.composite
def dense(draw: DrawFn) -> Case:
    """Draw J and f irregular in all their digits."""
    m, n = draw(integers(3, 7)), draw(integers(2, 5))
    salt = draw(integers(0, 99)) / 99
    J = _whole(draw, (m, n)) + jitter(m * n, salt).reshape(m, n)
    weights = numbers(draw, sampled_from(WEIGHTS), m) * (1.2 + jitter(m, salt))
    return system(J, weights, numbers(draw, integers(-99, 99), m) / 10 + jitter(m, salt + 0.4))


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


def square(case: Case) -> list[Case]:
    """Make four loops of one: two of its measurements as they are or 1 m off, and another second state for each.

    Each loop is judged by what the step answers when a measurement is changed, and here that is
    what it answers to a neighbour: such a call is made once.
    """
    (first, second), graph = case
    one, *_, other = loop_edges(graph)
    away = np.sign((second - first)[np.argmax(np.abs(second - first))])
    loops = (graph, nudged(graph, one), nudged(graph, other), nudged(nudged(graph, one), other))
    return [(np.array([first, second + away * shift]), loop) for shift, loop in enumerate(loops)]


def _two_states(draw: DrawFn, n_poses: int) -> np.ndarray:
    first, second = _states(draw, n_poses), _states(draw, n_poses)
    assume(np.abs(first - second).max() >= 1.0)
    return np.array([first, second])


@st.composite
def rangings(draw: DrawFn, exact: bool = False) -> Case:
    """Draw a state and ranges to a beacon anywhere but on the line; whole numbers where `exact`."""
    n = draw(integers(2, 3 if exact else 6))
    q = draw(integers(1, 2 if exact else 4))
    beacon = np.array([float(draw(integers(-9, 9))), _nonzero(draw, 1)[0]])
    poses = np.array(draw(several(integers(0, n - 1), q)))
    ranges = numbers(draw, integers(0, 99), q) / (1.0 if exact else 10.0)
    salt = 0.0 if exact else draw(integers(0, 99)) / 99
    shift = np.zeros(n) if exact else jitter(n, salt)
    x = numbers(draw, integers(-9, 9), n) + shift
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
