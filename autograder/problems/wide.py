"""The fixed core over the whole domain: what a pose graph may be beyond a walk near the origin with one prior.

Many priors, in any order; parts and poses that no edge joins to the rest; no walk 0 to n - 1; ten to
a hundred poses; numbers from millimetres to hundreds of metres, and states at, near and far from the minimum.
"""

from __future__ import annotations

import numpy as np

from assignment.posegraph import Ranging
from autograder.problems.cases import Case
from autograder.problems.core import graph
from autograder.problems.irregular import jitter, scatter
from autograder.problems.placing import almost_there, anywhere, far_out, near_the_minimum, two_starts
from autograder.problems.shapes import Shape, numbers_needed, shaped


def _state(*x: float) -> np.ndarray:
    return np.array(x, dtype=np.float64)


# Three priors, none in its place; four on two poses; two parts that interleave; a pose of its own; all of it.
_MIXED = graph(3, [(0, 1, 1.0, 0.01), (1, 2, 2.0, 0.04)], [(2, 4.0, 0.02), (0, -1.0, 0.05), (1, 0.5, 0.01)])
_CROWDED = graph(2, [(1, 0, -1.0, 0.02)], [(1, 3.0, 0.01), (0, 1.0, 0.05), (1, 0.0, 0.04), (1, 2.0, 0.02)])
_PARTS = graph(4, [(0, 2, 1.0, 0.02), (3, 1, 2.0, 0.01)], [(3, -2.0, 0.05), (0, 1.0, 0.04)])
_LONELY = graph(3, [(0, 1, 2.0, 0.01)], [(2, 3.0, 0.04), (0, 1.0, 0.02)])
_SCATTERED = graph(
    6,
    [(5, 0, 1.0, 0.04), (1, 4, -2.0, 0.01), (0, 5, 1.0, 0.02)],
    [(3, 2.0, 0.02), (1, -1.0, 0.01), (2, 4.0, 0.05), (5, 3.0, 0.02), (3, 1.0, 0.04)],
)
# A star, and a ring that jumps: connected, and not one edge of the walk 0, 1, 2, ... in the second.
_STAR = graph(5, [(2, 0, 1.0, 0.01), (4, 2, 2.0, 0.02), (2, 1, -1.0, 0.04), (2, 3, 1.0, 0.05), (0, 2, -2.0, 0.02)])
_JUMPS = graph(
    5,
    [(0, 2, 2.0, 0.02), (4, 2, 1.0, 0.01), (1, 4, -1.0, 0.05), (1, 3, 2.0, 0.04), (3, 0, 1.0, 0.02)],
    [(0, 0.0, 0.02)],
)
_SURE = graph(
    3, [(0, 1, 1.0, 4e-5), (1, 2, 2.0, 1e-5), (0, 2, 3.5, 2e-4)], [(0, 1.0, 1e-5), (2, 3.0, 4e-4), (1, 2.0, 2e-5)]
)
_UNSURE = graph(3, [(0, 1, 1.0, 200.0), (1, 2, 2.0, 1000.0), (2, 0, 6.0, 40.0)], [(0, 1.0, 400.0), (1, 5.0, 1000.0)])

# Firm edges that only a weak prior holds: cond(H) is some 1e5, and the weak direction is no noise.
_STIFF = (
    graph(2, [(0, 1, 1.0, 1e-4)], [(1, 3.0, 5.0)]),
    graph(3, [(0, 1, 1.0, 1e-4), (1, 2, 2.0, 4e-4), (0, 2, 2.5, 0.5)], [(1, 1.0, 2.0)]),
    graph(4, [(1, 3, 2.0, 2e-4), (0, 3, -1.0, 0.01), (2, 0, 1.0, 5e-4)], [(2, 4.0, 5.0), (2, 3.0, 10.0)]),
    graph(3, [(2, 0, 1.0, 2.5e-4)], [(1, 2.0, 120.0), (0, -1.0, 40.0)]),
    graph(5, [(i, i + 1, 1.0, 0.002) for i in range(4)], [(4, 6.0, 20.0)]),
)

PARTS_AND_PRIORS: tuple[Case, ...] = (
    (_state(1, -1), _CROWDED),
    (_state(1, 0, -2), _MIXED),
    (_state(2, 0, -1), _LONELY),
    (_state(1, 3, 3), _LONELY),  # the minimum itself
    (_state(1, 3, 0, -2), _PARTS),
    (_state(2, 1, -3, 0, 4, -1), _SCATTERED),
)
WITHOUT_A_WALK: tuple[Case, ...] = (
    (_state(1, 0, -2, 3, 2), _STAR),
    (_state(2, -1, 0, 1, 3), _JUMPS),
)
FAR_VARIANCES: tuple[Case, ...] = (
    (_state(1, 0, 2), _SURE),
    (_state(-1, 2, 4), _UNSURE),
    *((_state(2, -1, 3, 0, 1)[: each.n_poses], each) for each in _STIFF),
)


def _shape(n_poses: int, parts: int, loops: int, more_priors: int, salt: float, star: bool = False) -> Shape:
    return shaped(
        n_poses, parts, loops, more_priors, scatter(numbers_needed(n_poses, loops, more_priors), salt), star=star
    )


WIDE_VALUES: tuple[Case, ...] = (
    far_out(_shape(3, 1, 1, 0, 0.1), 0.3),
    far_out(_shape(5, 2, 1, 2, 0.4, star=True), 0.7),
    near_the_minimum(_shape(3, 1, 1, 0, 0.2), 0.2),
    near_the_minimum(_shape(6, 1, 2, 2, 0.5), 0.6),
    almost_there(_shape(3, 1, 1, 0, 0.6), 0.1),
    almost_there(_shape(4, 1, 0, 5, 0.8), 0.4),
    almost_there(_shape(5, 2, 1, 3, 0.3), 0.7),
)
MANY_POSES: tuple[Case, ...] = (
    anywhere(_shape(12, 1, 2, 0, 0.3), 0.1),
    anywhere(_shape(17, 1, 1, 2, 0.7, star=True), 0.5),
    anywhere(_shape(28, 3, 3, 4, 0.2), 0.8),
    near_the_minimum(_shape(38, 2, 4, 3, 0.9), 0.3),
    far_out(_shape(54, 4, 6, 0, 0.6), 0.9),
)


def _system(J: np.ndarray, weights: np.ndarray, f: np.ndarray) -> Case:
    return J.astype(np.float64), np.diag(weights.astype(np.float64)), f.astype(np.float64)


WIDE_WEIGHTS: tuple[Case, ...] = (
    _system(np.array([[2, 1], [1, -3], [1, 1]]), np.array([0.001, 0.0013, 0.7]), np.array([3, -1, 2])),
    _system(np.array([[1, 2], [3, -1], [0, 2]]), np.array([100000, 7000, 90000]), np.array([1, -2, 4])),
    _system(np.array([[1, 0, -2], [2, 1, 1], [0, 3, 1]]), np.array([20000, 0.3, 0.002]), np.array([-1, 2, 5])),
)
WIDE_RESIDUALS: tuple[Case, ...] = (
    _system(np.array([[2, 1], [-1, 3], [1, 1]]), np.array([7, 3, 11]), np.array([1000, -640, 270])),
    _system(3 * jitter(12, 0.9).reshape(4, 3), 9 + 6 * jitter(4, 0.1), 0.08 * jitter(4, 0.7)),
    _system(5 * jitter(15, 0.5).reshape(5, 3), 9 + 6 * jitter(5, 0.6), 1900 * jitter(5, 0.2)),
)
FEWER_ROWS: tuple[Case, ...] = (
    _system(np.array([[2, -1, 3]]), np.array([7]), np.array([2])),
    _system(np.array([[1, 3, 0], [2, 0, -1]]), np.array([3, 11]), np.array([-1, 4])),
    _system(3 * jitter(6 * 14, 0.8).reshape(6, 14), 9 + 6 * jitter(6, 0.3), 40 * jitter(6, 0.5)),
)


def _ranging(x: np.ndarray, beacon: tuple[float, float], poses: list[int], salt: float) -> Case:
    ranges = np.abs(x[poses] - beacon[0]) + 3.0 * (jitter(len(poses), salt) + 0.5)
    return x, Ranging(np.array(beacon), np.array(poses), ranges, np.full(len(poses), 0.01))


FAR_RANGES: tuple[Case, ...] = (
    _ranging(_state(-80, 60, 3), (7, 4), [1, 0], 0.1),
    _ranging(180.0 * jitter(4, 0.2), (-60, -0.3), [3, 0, 1, 2], 0.4),
    _ranging(100.0 * jitter(5, 0.6), (11, 70), [2, 4, 0], 0.8),
    _ranging(150.0 * jitter(14, 0.3), (20, -9), [13, 2, 11, 5, 2, 7], 0.6),
    _ranging(60.0 * jitter(40, 0.7), (-3, 2.5), [39, 0, 25], 0.2),
)


# A loop case: two states to start from, stacked, and the graph.
WIDE_LOOPS: tuple[Case, ...] = (
    (
        np.array([_state(1, 0, 2), _state(-1, 3, 0)]),
        graph(3, [(0, 1, 1.0, 0.01), (1, 2, 2.0, 0.04), (2, 0, -2.0, 0.02)], [(2, 4.0, 0.05), (0, 1.0, 0.02)]),
    ),
    (np.array([_state(1, 0, -2, 3, 2), _state(0, 2, 1, -1, 4)]), _STAR),
    (np.array([_state(2, 1, -3, 0, 4, -1), _state(0, 0, 1, 3, 1, 2)]), _SCATTERED),
    (np.array([_state(-1, 2, 4), _state(3, 0, -2)]), _SURE),
    (np.array([_state(1, 0, 2), _state(4, 1, -1)]), _UNSURE),
    two_starts(far_out(_shape(3, 1, 1, 0, 0.5), 0.7)),
    two_starts(far_out(_shape(5, 1, 1, 1, 0.3), 0.2)),
    two_starts(far_out(_shape(6, 4, 1, 1, 0.9, star=True), 0.3)),
    two_starts(far_out(_shape(3, 1, 1, 1, 0.1, star=True), 0.8)),
    two_starts(far_out(_shape(4, 1, 1, 0, 0.7), 0.1)),
    two_starts(near_the_minimum(_shape(3, 1, 1, 1, 0.2), 0.7)),
    two_starts(near_the_minimum(_shape(5, 3, 1, 2, 0.6), 0.4)),
    two_starts(almost_there(_shape(3, 1, 1, 0, 0.9, star=True), 0.2)),
    two_starts(almost_there(_shape(4, 1, 1, 5, 0.8), 0.4)),
    two_starts(near_the_minimum(_shape(3, 1, 1, 0, 0.8), 0.1)),
    two_starts(near_the_minimum(_shape(4, 1, 1, 0, 0.1, star=True), 0.9)),
    two_starts(almost_there(_shape(3, 1, 1, 2, 0.4, star=True), 0.3)),
    two_starts(almost_there(_shape(3, 2, 1, 0, 0.7), 0.8)),
    two_starts(anywhere(_shape(10, 1, 1, 0, 0.3), 0.4)),
    two_starts(anywhere(_shape(11, 2, 1, 1, 0.5), 0.2)),
    two_starts(anywhere(_shape(12, 1, 1, 2, 0.4), 0.6)),
    two_starts(anywhere(_shape(13, 1, 1, 1, 0.6), 0.5)),
    two_starts(anywhere(_shape(30, 3, 1, 1, 0.7), 0.9)),
)
