"""Strategies for witnesses: small cases of whole numbers, which a student can redo by hand.

Where whole numbers hide a mistake, sixty-fourths are tried: their six decimals show what rounding hides.
Then graphs in parts and with many priors, numbers far out and below a millimetre, and variances that are far from 1.
"""

from __future__ import annotations

import numpy as np
from hypothesis import assume
from hypothesis import strategies as st
from hypothesis.strategies import DrawFn, SearchStrategy

from autograder.problems.cases import Case
from autograder.problems.chance import numbers
from autograder.problems.core import graph as graph_of
from autograder.problems.drawn_systems import rangings, system
from autograder.problems.graphs import reachable
from autograder.problems.strategies import chain

_small = st.integers(-3, 3).map(float)
_sixty_fourths = st.integers(-99, 99).map(lambda k: k / 64)
_tiny_variances = st.sampled_from((1.0, 2.0, 4.0))
_odd_variances = st.sampled_from((0.75, 3.0, 7.0, 96.0))
_WHOLE = (_small, _tiny_variances)
_FINE = (_sixty_fourths, _odd_variances)
_FAR = (st.integers(-3, 3).map(lambda k: 25.0 * k), _tiny_variances)
_BELOW_A_MILLIMETRE = (st.integers(-3, 3).map(lambda k: k / 8192), _tiny_variances)
_SURE = (_small, st.sampled_from((1e-5, 2e-5, 4e-5)))
_STIFF = (_small, st.sampled_from((1e-4, 5.0)))
_HEAVY_AND_LIGHT = (_small, st.sampled_from((1.0, 0.001, 1e5)))  # weights
Numbers = tuple[SearchStrategy[float], SearchStrategy[float]]
"""How the values and the variances of a small case are drawn."""


def _edges(pairs: SearchStrategy[tuple[int, int]], kind: Numbers) -> SearchStrategy[tuple[int, int, float, float]]:
    """Draw an edge with its data in one piece, so that the shrinker can drop it in one piece."""
    return st.tuples(pairs, *kind).map(lambda drawn: (*drawn[0], drawn[1], drawn[2]))


def _any_pair(n_poses: int) -> SearchStrategy[tuple[int, int]]:
    both = st.tuples(st.integers(0, n_poses - 1), st.integers(1, n_poses - 1))
    return both.map(lambda drawn: (drawn[0], (drawn[0] + drawn[1]) % n_poses))


@st.composite
def small_graphs(draw: DrawFn, low: int = 2, high: int = 3, kind: Numbers = _WHOLE) -> Case:
    """Draw a graph of two or three poses (or as told); it shrinks to a walk without a loop."""
    n = draw(st.integers(low, high))
    edges = [draw(_edges(st.just(pair), kind)) for pair in chain(n)]
    edges += draw(st.lists(_edges(_any_pair(n), kind), max_size=2))
    if draw(st.booleans()):
        edges = edges[::-1]
    priors = draw(st.lists(st.tuples(st.integers(0, n - 1), *kind), min_size=1, max_size=2))
    return numbers(draw, kind[0], n), graph_of(n, edges, priors)


@st.composite
def small_parts(draw: DrawFn, kind: Numbers = _WHOLE) -> Case:
    """Draw a graph of two to four poses that need not hang together, with up to four priors and one in every part."""
    n = draw(st.integers(2, 4))
    edges = draw(st.lists(_edges(_any_pair(n), kind), min_size=1, max_size=3))
    priors = draw(st.lists(st.tuples(st.integers(0, n - 1), *kind), max_size=4))
    held = {pose for pose, *_ in priors}
    for pose in range(n):
        if not held & reachable(pose, [(i, j) for i, j, *_ in edges]):
            priors.append((pose, draw(kind[0]), draw(kind[1])))
            held.add(pose)
    return numbers(draw, kind[0], n), graph_of(n, edges, priors)


@st.composite
def small_matrices(draw: DrawFn, columns: tuple[int, int] = (1, 2), kind: Numbers = _WHOLE, rows: int = 3) -> Case:
    """Draw J, Omega and f of a few rows and columns."""
    m, n = draw(st.integers(1, rows)), draw(st.integers(*columns))
    J = numbers(draw, kind[0], m * n).reshape(m, n)
    return system(J, numbers(draw, kind[1], m), numbers(draw, kind[0], m))


@st.composite
def small_loops(draw: DrawFn, kind: Numbers = _WHOLE) -> Case:
    """Draw a loop of two or three poses and two states."""
    n = draw(st.integers(2, 3))
    edges = [draw(_edges(st.just(pair), kind)) for pair in [*chain(n), (0, n - 1)]]
    states = np.array([numbers(draw, kind[0], n), numbers(draw, kind[0], n)])
    assume(np.abs(states[0] - states[1]).max() >= 1.0)
    return states, graph_of(n, edges, [(0, 0.0, 1.0)])


@st.composite
def small_held_loops(draw: DrawFn) -> Case:
    """Draw a loop of two or three poses with one to three priors, and two states."""
    n = draw(st.integers(2, 3))
    edges = [draw(_edges(st.just(pair), _WHOLE)) for pair in [*chain(n), (0, n - 1)]]
    states = np.array([numbers(draw, _small, n), numbers(draw, _small, n)])
    assume(np.abs(states[0] - states[1]).max() >= 1.0)
    return states, graph_of(n, edges, draw(st.lists(st.tuples(st.integers(0, n - 1), *_WHOLE), min_size=1, max_size=3)))


@st.composite
def small_inner_loops(draw: DrawFn, kind: Numbers = _WHOLE) -> Case:
    """Draw a loop of two or three poses inside a walk of four or five, the prior anywhere, and two states."""
    n = draw(st.integers(4, 5))
    first = draw(st.integers(0, n - 2))
    last = draw(st.integers(first + 1, min(n - 1, first + 2)))
    edges = [draw(_edges(st.just(pair), kind)) for pair in [*chain(n), (first, last)]]
    states = np.array([numbers(draw, kind[0], n), numbers(draw, kind[0], n)])
    assume(np.abs(states[0] - states[1]).max() >= 1.0)
    return states, graph_of(n, edges, [(draw(st.integers(0, n - 1)), 0.0, 1.0)])


# Tried in this order; the first that holds a wrong case is searched for the smallest one.
WITNESSES: dict[str, tuple[SearchStrategy[Case], ...]] = {
    "graphs": (
        small_graphs(),
        small_parts(),
        small_graphs(2, 2, _FINE),
        *(small_graphs(2, 2, kind) for kind in (_FAR, _BELOW_A_MILLIMETRE, _SURE, _STIFF)),
        small_graphs(4, 6),
    ),
    "matrices": (
        small_matrices((1, 1), rows=1),  # the shrinker leaves a row of zeros
        small_matrices(),
        *(small_matrices((1, 1), kind) for kind in (_FINE, _FAR, _HEAVY_AND_LIGHT)),
        small_matrices((3, 5)),
    ),
    "loops": (small_loops(), small_held_loops(), small_loops(_FINE), small_inner_loops()),
    "rangings": (rangings(exact=True), rangings()),
}

# How many cases the gallery draws from each, for mistakes that no catalogue knows.
DRAWN: dict[str, tuple[tuple[SearchStrategy[Case], int], ...]] = {
    "graphs": (
        (small_graphs(), 60),
        (small_graphs(4, 6), 30),
        (small_parts(), 30),
        *((small_graphs(2, 2, kind), 6) for kind in (_FAR, _BELOW_A_MILLIMETRE, _SURE, _STIFF)),
    ),
    "matrices": (
        (small_matrices(), 60),
        (small_matrices((3, 5)), 10),
        *((small_matrices((1, 2), kind), 6) for kind in (_FAR, _BELOW_A_MILLIMETRE, _HEAVY_AND_LIGHT)),
    ),
    "loops": ((small_loops(), 40), (small_inner_loops(), 20), (small_held_loops(), 20)),
    "rangings": ((rangings(exact=True), 40),),
}
