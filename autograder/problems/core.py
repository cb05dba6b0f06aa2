"""The fixed core of the ladders: hand-picked cases that show every known mistake under every seed."""

from __future__ import annotations

import dataclasses

import numpy as np

from assignment.posegraph import PoseGraph, Ranging
from autograder.problems.cases import Case
from autograder.problems.families.worked_example import worked_example
from autograder.problems.irregular import GOLDEN, jitter


def graph(
    n_poses: int,
    edges: list[tuple[int, int, float, float]],
    priors: list[tuple[int, float, float]] | None = None,
) -> PoseGraph:
    """Build a graph from rows (i, j, measurement, variance) and (pose, mean, variance)."""
    priors = [(0, 0.0, 0.001)] if priors is None else priors
    return PoseGraph(
        n_poses,
        np.array([row[:2] for row in edges]),
        np.array([row[2] for row in edges]),
        np.array([row[3] for row in edges]),
        np.array([row[0] for row in priors]),
        np.array([row[1] for row in priors]),
        np.array([row[2] for row in priors]),
    )


def _state(*x: float) -> np.ndarray:
    return np.array(x, dtype=np.float64)


_E = worked_example()
_V = graph(5, [(0, 1, 1.1, 0.01), (1, 2, 1.0, 0.02), (2, 3, 1.1, 0.05), (3, 4, -2.7, 0.04), (0, 4, 0.0, 0.02)])
_Z = graph(5, [(0, 1, 1.1, 0.01), (1, 2, 1.0, 0.01), (2, 3, 1.1, 0.04), (3, 4, -2.7, 0.01), (0, 4, 0.3, 0.01)])
_N = graph(3, [(0, 1, 1.0, 0.01), (1, 2, 2.0, 0.02), (0, 2, 2.0, 0.04)])
_TWICE = graph(2, [(0, 1, 1.0, 0.04), (0, 1, 2.0, 0.01)])
_I = graph(
    6,
    [(0, 1, 1.0, 0.01), (1, 2, 1.0, 0.02), (2, 3, 1.0, 0.04), (3, 4, -2.0, 0.01), (4, 5, 1.0, 0.02), (1, 4, 0.5, 0.05)],
)
_L = graph(
    5,
    [
        (0, 1, 1.1, 0.01),
        (1, 2, 1.0, 0.02),
        (2, 3, 1.1, 0.04),
        (3, 4, -2.7, 0.01),
        (0, 3, 3.0, 0.02),
        (1, 4, -0.5, 0.05),
    ],
)
_B = graph(5, [(0, 1, 1.1, 0.01), (1, 2, 1.0, 0.02), (3, 2, -1.1, 0.04), (3, 4, -2.7, 0.01), (4, 0, 0.2, 0.02)])
_O = graph(4, [(0, 3, 2.0, 0.02), (0, 1, 1.0, 0.01), (1, 2, 2.0, 0.04), (2, 3, -2.0, 0.05)])
_DOUBLED = graph(3, [(1, 2, 2.0, 0.02), (0, 1, 1.0, 0.01), (2, 1, -1.0, 0.04), (0, 1, 2.0, 0.02), (0, 2, 2.0, 0.05)])
_P = graph(3, [(0, 1, 1.0, 0.01), (1, 2, 1.0, 0.02), (0, 2, 3.0, 0.04)], [(0, 2.0, 0.01)])
_Q = graph(
    5,
    [(0, 1, 1.1, 0.01), (1, 2, 1.0, 0.02), (2, 3, 1.1, 0.04), (3, 4, -2.7, 0.01), (0, 4, 0.0, 0.02)],
    [(0, 0.0, 0.001), (3, 2.5, 0.02)],
)
_ELSEWHERE = graph(3, [(0, 1, 1.0, 0.01), (1, 2, 2.0, 0.04), (0, 2, 2.0, 0.02)], [(2, -1.0, 0.05)])
_SWAPPED = graph(3, [(0, 1, 1.0, 0.02), (1, 2, 1.0, 0.01), (0, 2, 3.0, 0.05)], [(2, 4.0, 0.02), (0, 1.0, 0.05)])
_SAME_POSE = graph(2, [(0, 1, 1.0, 0.01)], [(1, 1.0, 0.02), (1, 3.0, 0.05)])
_DECADES = graph(
    4, [(0, 1, 1.0, 0.001), (1, 2, 1.0, 0.1), (2, 3, 1.0, 10.0), (0, 3, 2.0, 1.0)], [(0, 0.0, 1.0), (3, 5.0, 0.01)]
)
_SOFT = graph(3, [(0, 1, 1.0, 5.0), (1, 2, 2.0, 20.0), (0, 2, 6.0, 10.0)], [(0, 1.0, 50.0)])
_FIRM = graph(3, [(0, 1, 1.0, 0.005), (1, 2, 2.0, 0.002), (0, 2, 4.0, 0.001)], [(0, 1.0, 0.0005), (1, 3.0, 0.02)])


def _real(n_poses: int, edges: list[tuple[int, int]], priors: list[int], salt: float) -> Case:
    """Make a real-valued graph on the given pairs, and a state far from dead reckoning."""
    k, p = len(edges), len(priors)
    made = PoseGraph(
        n_poses,
        np.array(edges),
        4.0 * jitter(k, salt),
        0.01 * 4.0 ** (2.0 * jitter(k, salt + 0.3)),
        np.array(priors),
        6.0 * jitter(p, salt + 0.7),
        0.02 * 4.0 ** (2.0 * jitter(p, salt + 0.1)),
    )
    return 30.0 * jitter(n_poses, salt + 0.5), made


def _hundred() -> Case:
    """Make one walk of 100 poses with a closing about every eighth pose, shuffled and partly reversed."""
    chain = [(i, i + 1) for i in range(99)]
    loops = [(i, (i * 7 + 20) % 100) for i in range(3, 100, 8)]
    pairs = sorted(chain + loops, key=lambda pair: (pair[0] * GOLDEN + pair[1] * 0.37) % 1.0)
    turned = [(j, i) if (i + j) % 3 == 0 else (i, j) for i, j in pairs]
    return _real(100, turned, [40, 3], 0.2)


def _near() -> Case:
    """Make a state near the minimum and far from the origin: x has large numbers, f small ones."""
    _, made = _real(6, [(4, 3), (0, 1), (1, 2), (5, 4), (3, 2), (1, 4)], [2, 5], 0.25)
    chain = [0.0, 1.3, 0.4, -1.2, 0.9, 2.2]
    x = 30.0 + np.array(chain) + jitter(6, 0.8)
    i, j = made.edges.T
    measured = x[j] - x[i] + 0.2 * jitter(len(i), 0.15)
    means = x[made.priors] + 0.2 * jitter(2, 0.45)
    return x, PoseGraph(6, made.edges, measured, made.edge_variances, made.priors, means, made.prior_variances)


WORKED_EXAMPLE: tuple[Case, ...] = (
    (_E.dead_reckoning(), _E),
    (_state(0, 0, 0, 0, 0), _E),
    (_state(1, -2, 3, 0.5, 4), _E),
)
SINGLE_LOOPS: tuple[Case, ...] = (
    (_state(0, 0), _TWICE),
    (_state(0, 0, 0), _N),
    (_state(1, -1, 4), _N),
    (_V.dead_reckoning(), _V),
    (_state(2, 0, -1, 3, 1), _V),
    (_state(0, 1, 1, 2, 2), _Z),
)
SEVERAL_LOOPS: tuple[Case, ...] = (
    (_state(0, 0, 0), _DOUBLED),
    (_state(3, 1, -2), _DOUBLED),
    (_state(1, 2, 0, -1), _O),
    (_B.dead_reckoning(), _B),
    (_state(2, 0, 1, -1, 3), _B),
    (_state(1, 0, 2, -1, 1), _L),
    (_state(2, 1, 3, 0, -1, 4), _I),
)
PRIORS: tuple[Case, ...] = (
    (_state(0, 0), _SAME_POSE),
    (_state(0, 0, 0), _P),
    (_state(1, 0, 2), _ELSEWHERE),
    (_state(3, 1, -1), _SWAPPED),
    (_state(1, 0, 2, 4, -1), _Q),
)
VARIANCES: tuple[Case, ...] = (
    (_state(0, 1, 2), _SOFT),
    (_state(1, 0, 3), _FIRM),
    (_state(0, 1, 2, 3), _DECADES),
    (_state(4.1, -1.3, 2.2, 0.7), _DECADES),
)
REAL_VALUED: tuple[Case, ...] = (
    _real(3, [(0, 1), (1, 2), (0, 2)], [0], 0.0),
    _real(4, [(2, 3), (1, 0), (1, 2), (0, 3)], [2, 0], 0.9),
    _real(8, [(3, 4), (0, 1), (5, 4), (1, 2), (2, 3), (6, 2), (5, 6), (6, 7), (1, 5)], [3, 0], 0.4),
    _near(),
)
MANY_POSES: tuple[Case, ...] = (_hundred(),)


def _system(J: np.ndarray, weights: np.ndarray, f: np.ndarray) -> Case:
    return J.astype(np.float64), np.diag(weights.astype(np.float64)), f.astype(np.float64)


def _walk(n_poses: int, salt: float) -> Case:
    """Make a J with -1 and +1 in a row, the other sign than a between factor, and a last row of +1."""
    J = np.zeros((n_poses + 1, n_poses))
    for row in range(n_poses):
        J[row, row], J[row, (row + 1) % n_poses] = -1.0, 1.0
    J[n_poses, n_poses // 2] = 1.0
    return _system(J, 3.0 + 9.0 * (jitter(n_poses + 1, salt) + 0.5), 5.0 * jitter(n_poses + 1, salt + 0.6))


WHOLE_NUMBERS: tuple[Case, ...] = (
    _system(np.array([[1, 2], [0, 1]]), np.array([3, 7]), np.array([1, -2])),
    _system(np.array([[2, 0], [1, -1], [0, 3]]), np.array([3, 11, 7]), np.array([2, 1, -1])),
    _system(np.array([[1, -2, 0], [0, 1, 3], [4, 0, 1]]), np.array([7, 3, 13]), np.array([1, 0, -3])),
    _system(
        np.array([[1, 1, 2], [3, 0, -1], [0, 2, 1], [1, -1, 0]]), np.array([3, 7, 11, 13]), np.array([1, 2, -1, 4])
    ),
)
UNEQUAL_WEIGHTS: tuple[Case, ...] = (
    _system(np.array([[1, -1], [2, 1], [0, 1]]), np.array([300, 0.7, 3]), np.array([1, -3, 2])),
    _system(np.array([[1, 0, 2], [0, -1, 1], [1, 1, 0]]), np.array([0.03, 70, 3000]), np.array([-2, 1, 1])),
)
GRAPH_SHAPED: tuple[Case, ...] = (_walk(7, 0.0), _walk(8, 0.5), _walk(9, 0.8))
DENSE: tuple[Case, ...] = (
    _system(4 * jitter(12).reshape(4, 3), 3 + 7 * (jitter(4, 0.2) + 0.5), 6 * jitter(4, 0.4)),
    _system(4 * jitter(35, 0.1).reshape(7, 5), 0.3 * 50 ** (2 * jitter(7, 0.2)), 6 * jitter(7, 0.9)),
    _system(4 * jitter(20, 0.7).reshape(5, 4), 30 * 9 ** (2 * jitter(5, 0.2)), 6 * jitter(5, 0.3)),
)
LARGE: tuple[Case, ...] = (
    _system(4 * jitter(80 * 60, 0.3).reshape(80, 60), 0.3 * 50 ** (2 * jitter(80, 0.8)), 6 * jitter(80, 0.1)),
)


def _ranging(x: np.ndarray, beacon: tuple[float, float], *rows: tuple[int, float]) -> Case:
    """Make a ranging of (pose, range) rows; the variances play no part in what is asked."""
    poses, ranges = np.array([row[0] for row in rows]), np.array([row[1] for row in rows])
    return x, Ranging(np.array(beacon), poses, ranges, np.full(len(rows), 0.01))


RANGES: tuple[Case, ...] = (
    _ranging(_state(0, 6), (3, 4), (0, 5), (1, 4.5)),
    _ranging(_state(2, -1), (2, -1), (0, 1.5)),
    _ranging(_state(0, 1.1, 2.1, 3.2, 0.5), (2, 1), (3, 1.4)),
    _ranging(_state(-5, 7, 3), (-2, 4), (2, 1), (0, 6), (2, 2.5)),
    _ranging(30 * jitter(6, 0.1), (3.7, -0.3), (5, 2.25), (0, 9.75), (3, 0.5), (4, 12.5)),
)


# A loop case: two states to start from, stacked, and the graph. A step that is rounded to some decimals
# shows only from a state with more of them, and one in single precision only with a prior that pulls weakly.
def _real_loop(n_poses: int, edges: list[tuple[int, int]], prior: int, variance: float, salt: float) -> Case:
    """Make a real-valued loop with one prior, and two states with irregular digits."""
    x, made = _real(n_poses, edges, [prior], salt)
    held = dataclasses.replace(made, prior_variances=np.array([variance]))
    return np.array([0.1 * x, 1.0 - 0.1 * x[::-1]]), held


def _far_loop() -> Case:
    """Make a loop with states far out, where a difference quotient with a tiny step drowns in rounding."""
    _, made = _real(4, [(0, 1), (1, 2), (2, 3), (0, 3)], [0], 0.3)
    return np.array([180.0 * jitter(4, 0.8), -150.0 * jitter(4, 0.5)]), made


WORKED_LOOP: tuple[Case, ...] = ((np.array([_E.dead_reckoning(), _state(1, -2, 3, 0.5, 4)]), _E),)
FULL_LOOPS: tuple[Case, ...] = (
    (np.array([_state(0, 0), _state(3, -1)]), _TWICE),
    (np.array([_state(0, 0, 0), _state(1, -1, 4)]), _N),
    (np.array([_V.dead_reckoning(), _state(2, 0, -1, 3, 1)]), _V),
    (np.array([_state(0, 0, 0), _state(1, -1, 4)]), _SOFT),
    _real_loop(3, [(0, 1), (1, 2), (0, 2)], 0, 0.02, 0.35),
    _real_loop(4, [(0, 1), (1, 2), (2, 3), (0, 3)], 0, 20.0, 0.85),
    _far_loop(),
)
INNER_LOOPS: tuple[Case, ...] = (
    (np.array([_state(0, 0, 0), _state(3, 1, -2)]), _ELSEWHERE),
    (np.array([_B.dead_reckoning(), _state(2, 0, 1, -1, 3)]), _B),
    (np.array([_state(0, 0, 0, 0, 0, 0), _state(2, 1, 3, 0, -1, 4)]), _I),
    _real_loop(5, [(3, 4), (1, 0), (1, 2), (3, 2), (3, 1)], 4, 0.02, 0.6),
    _real_loop(5, [(2, 3), (0, 1), (3, 1), (1, 2), (4, 3)], 4, 20.0, 0.5),
)
