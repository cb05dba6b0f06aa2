"""Hypothesis strategies that draw further cases for every rung of the ladders: graphs, and loops in them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from hypothesis import assume
from hypothesis import strategies as st
from hypothesis.strategies import DrawFn, SearchStrategy

from assignment.posegraph import PoseGraph
from autograder.problems import placing
from autograder.problems.cases import Case
from autograder.problems.chance import (
    between,
    booleans,
    displacements,
    drawn,
    integers,
    order,
    sampled_from,
    states_in_tenths,
)
from autograder.problems.drawn_systems import dense, graph_shaped, rangings, unequal_weights, whole_numbers
from autograder.problems.graphs import MAX_CONDITION, information, loop_edges, nudged, tells
from autograder.problems.irregular import jitter, scatter
from autograder.problems.shapes import Shape, numbers_needed, shaped

VARIANCES = (0.01, 0.02, 0.04, 0.05, 0.1)
DECADES = (0.002, 0.01, 0.05, 0.2, 1.0, 5.0, 20.0)
BANDS = (DECADES, (1e-5, 4e-5, 2e-4, 0.001, 0.005), (0.5, 5.0, 40.0, 200.0, 1000.0), (4e-4, 0.003, 0.05, 2.0, 20.0))
NARROW = (VARIANCES, (1e-5, 2e-5, 5e-5, 1e-4), (100.0, 200.0, 500.0, 1000.0))  # a loop moves with each of its edges
PLACES = (placing.anywhere, placing.far_out, placing.near_the_minimum, placing.almost_there)


def chain(n_poses: int) -> list[tuple[int, int]]:
    """Return the pairs of a walk 0 -> 1 -> ... ."""
    return [(i, i + 1) for i in range(n_poses - 1)]


def _measured(
    draw: DrawFn,
    n_poses: int,
    pairs: list[tuple[int, int]] | np.ndarray,
    variances: tuple[float, ...],
    priors: list[int] | np.ndarray,
) -> PoseGraph:
    k, p = len(pairs), len(priors)
    first_is_origin = list(priors) == [0]
    measurements = displacements(draw, k)
    edge_variances = drawn(draw, variances, k)
    means = np.zeros(1) if first_is_origin else displacements(draw, p)
    prior_variances = drawn(draw, variances if variances in NARROW[1:] else (0.001, *variances), p)
    return PoseGraph(n_poses, np.array(pairs), measurements, edge_variances, np.array(priors), means, prior_variances)


@st.composite
def single_loops(draw: DrawFn) -> Case:
    """Draw a walk of 2 to 6 poses with one loop closure from the first to the last."""
    n = draw(integers(2, 6))
    graph = _measured(draw, n, [*chain(n), (0, n - 1)], VARIANCES, [0])
    return states_in_tenths(draw, n), graph


def _pair(draw: DrawFn, n_poses: int) -> tuple[int, int]:
    i = draw(integers(0, n_poses - 1))
    return i, (i + draw(integers(1, n_poses - 1))) % n_poses


def _tangled(draw: DrawFn, low: int, high: int) -> tuple[int, list[tuple[int, int]]]:
    n = draw(integers(low, high))
    pairs = chain(n) + [_pair(draw, n) for _ in range(draw(integers(1, 3)))]
    turned = drawn(draw, (0, 1), len(pairs)).tolist()
    pairs = [(j, i) if turn else (i, j) for (i, j), turn in zip(pairs, turned, strict=True)]
    return n, [pairs[place] for place in order(draw, len(pairs))]


def _salt(draw: DrawFn) -> float:
    return float(drawn(draw, between(0, 98), 2) @ (1 / 99, 1 / 9801))


def _shape(
    draw: DrawFn, low: int, high: int, parts: int = 1, loops: tuple[int, int] = (0, 2), more_priors: int = 0
) -> Shape:
    """Draw how many poses, parts (at the most so many), loops and more priors there are, and what decides the rest."""
    count = drawn(draw, between(0, 98), 4).astype(int).tolist()
    n = low + count[0] % (high - low + 1)
    n_parts, n_loops = 1 + count[1] % min(parts, n - 1), loops[0] + count[2] % (loops[1] - loops[0] + 1)
    more = count[3] % (more_priors + 1)
    chance = scatter(numbers_needed(n, n_loops, more), _salt(draw))
    return shaped(n, n_parts, n_loops, more, chance, star=draw(booleans))


def _placed(draw: DrawFn, shape: Shape) -> Case:
    """Draw where the poses of a shape stand."""
    place: Callable[[Shape, float], Case] = draw(sampled_from(PLACES))
    return place(shape, _salt(draw))


@st.composite
def several_loops(draw: DrawFn) -> Case:
    """Draw a walk, a tree or a star with one to three more edges anywhere, some backward, in any order."""
    if draw(booleans):
        n, pairs = _tangled(draw, 3, 6)
        return states_in_tenths(draw, n), _measured(draw, n, pairs, VARIANCES, [0])
    shape = _shape(draw, 3, 6, loops=(1, 3))
    return states_in_tenths(draw, shape.n_poses), _measured(draw, shape.n_poses, shape.pairs, VARIANCES, [0])


def _prior_poses(draw: DrawFn, n_poses: int) -> np.ndarray:
    return drawn(draw, between(0, n_poses - 1), draw(integers(1, 4))).astype(int)


def _held(draw: DrawFn, variances: tuple[float, ...]) -> Case:
    """Draw a walk with priors on any of its poses, or several parts, each with its own prior."""
    if draw(booleans):
        n, pairs = _tangled(draw, 2, 5)
        return states_in_tenths(draw, n), _measured(draw, n, pairs, variances, _prior_poses(draw, n))
    shape = _shape(draw, 3, 7, parts=4, loops=(0, 1), more_priors=3)
    graph = _measured(draw, shape.n_poses, shape.pairs, variances, shape.priors)
    return states_in_tenths(draw, shape.n_poses), graph


@st.composite
def priors(draw: DrawFn) -> Case:
    """Draw a graph whose priors stand on any pose, in any number and order, with any mean."""
    return _held(draw, VARIANCES)


@st.composite
def variances(draw: DrawFn) -> Case:
    """Draw a graph with variances from 1e-5 to 1000 m^2, of up to five powers of ten in one graph."""
    x, graph = _held(draw, draw(sampled_from(BANDS)))
    assume(np.linalg.cond(information(graph)) <= MAX_CONDITION)
    return x, graph


@st.composite
def real_valued(draw: DrawFn) -> Case:
    """Draw a graph and a state, every number irregular in all its digits; far out, near the minimum or anywhere."""
    if draw(integers(0, 2)):
        shape = _shape(draw, 2, 7, parts=3, more_priors=3)
        return _placed(draw, shape)
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
    return 9.0 * states_in_tenths(draw, n) + jitter(n, salt + 0.6), graph


@st.composite
def many_poses(draw: DrawFn) -> Case:
    """Draw a graph of 10 to 40 poses, of all shapes, and a state anywhere."""
    shape = _shape(draw, 10, 40, parts=4, loops=(0, 4), more_priors=5)
    return _placed(draw, shape)


@st.composite
def full_loops(draw: DrawFn) -> Case:
    """Draw a loop through all poses, and two states to start from."""
    n = draw(integers(2, 5))
    graph = _measured(draw, n, [*chain(n), (0, n - 1)], VARIANCES, [0])
    return _two_states(draw, n), graph


@st.composite
def loops_in_graphs(draw: DrawFn) -> Case:
    """Draw a graph of any shape that has a loop, with any priors and numbers, and two states to start from."""
    kind = draw(integers(0, 9))
    shape = _shape(draw, *((3, 7) if kind < 9 else (10, 30)), parts=3, loops=(1, 2 if kind < 9 else 1), more_priors=3)
    if kind < 5:
        graph = _measured(draw, shape.n_poses, shape.pairs, draw(sampled_from(NARROW)), shape.priors)
        case = _two_states(draw, shape.n_poses), graph
    else:
        case = placing.two_starts(_placed(draw, shape))
    assume(tells(*case))
    return case


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
    first, second = states_in_tenths(draw, n_poses), states_in_tenths(draw, n_poses)
    assume(np.abs(first - second).max() >= 1.0)
    return np.array([first, second])


STRATEGIES: dict[str, dict[str, SearchStrategy[Case]]] = {
    "graphs": {
        "single_loops": single_loops(),
        "several_loops": several_loops(),
        "priors": priors(),
        "variances": variances(),
        "real_valued": real_valued(),
        "many_poses": many_poses(),
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
