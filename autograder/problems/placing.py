"""Where the poses of a shape stand, what is measured there, and the state at which a case asks.

At the place where the poses stand, f is the errors of the measurements. So a state can be put near the
minimum, almost at it, or far out, without solving anything: no case depends on a machine's arithmetic.
"""

from __future__ import annotations

import numpy as np

from assignment.posegraph import PoseGraph
from autograder.problems.cases import Case
from autograder.problems.irregular import jitter, scatter
from autograder.problems.shapes import Shape


def seen_from(shape: Shape, variances: np.ndarray, truth: np.ndarray, errors: np.ndarray, x: np.ndarray) -> Case:
    """Make a case of a shape: what is measured where the poses stand at `truth`, with these errors.

    Measured to the nanometre, so that a measurement that is changed by 1 m and changed back is the same again.

    Parameters
    ----------
    shape : Shape
        Which poses the factors touch.
    variances, errors : (m,) float arrays
        Of the edges, then of the priors [m^2], [m].
    truth, x : (n,) float arrays
        Where the poses stand, and the state at which the case asks [m].

    Examples
    --------
    >>> shape = Shape(2, np.array([[0, 1]]), np.array([0]))
    >>> x, graph = seen_from(shape, np.ones(2), np.array([1.0, 4.0]), np.array([0.5, 0.25]), np.zeros(2))
    >>> graph.measurements, graph.prior_means
    (array([3.5]), array([0.75]))
    """
    k = len(shape.pairs)
    i, j = shape.pairs.T
    measured, means = truth[j] - truth[i] + errors[:k], truth[shape.priors] - errors[k:]
    return x, PoseGraph(
        shape.n_poses, shape.pairs, measured.round(9), variances[:k], shape.priors, means, variances[k:]
    )


def variances_of(shape: Shape, salt: float) -> np.ndarray:
    """Return irregular variances from 0.0025 to 0.04 m^2, for the edges, then the priors."""
    spread = jitter(len(shape.pairs) + len(shape.priors), salt) + 0.5
    return 0.0025 * (1.0 + 15.0 * spread * spread)


def anywhere(shape: Shape, salt: float) -> Case:
    """Make a case with numbers of a few metres, and a state that has nothing to do with the measurements."""
    n, m = shape.n_poses, len(shape.pairs) + len(shape.priors)
    truth, errors = 9.0 * jitter(n, salt), jitter(m, salt + 0.4)
    return seen_from(shape, variances_of(shape, salt), truth, errors, 20.0 * jitter(n, salt + 0.5))


def far_out(shape: Shape, salt: float) -> Case:
    """Make a case in which poses stand up to 98 m from the origin on both sides, and measurements come to 200 m."""
    n, m = shape.n_poses, len(shape.pairs) + len(shape.priors)
    side = np.where(scatter(n, salt + 0.3) < 0.5, -1.0, 1.0)
    truth = side * (60.0 + 38.0 * scatter(n, salt))
    x = np.where(np.arange(n) % 2, 60.0, -80.0) + 30.0 * jitter(n, salt + 0.2)
    return seen_from(shape, variances_of(shape, salt), truth, 2.0 * jitter(m, salt + 0.4), x)


def near_the_minimum(shape: Shape, salt: float) -> Case:
    """Make a case in which every row of f is below 5 cm, and none is 0."""
    n, m = shape.n_poses, len(shape.pairs) + len(shape.priors)
    truth, errors = 60.0 * jitter(n, salt), 0.04 * jitter(m, salt + 0.4)
    return seen_from(shape, variances_of(shape, salt), truth, errors, truth + 0.02 * jitter(n, salt + 0.6))


def almost_there(shape: Shape, salt: float) -> Case:
    """Make a case whose step is shorter than 1 mm, though two factors between the same poses contradict each other.

    Their pulls, error over variance, cancel: at the truth the gradient is 0, and f is not.
    """
    n, m = shape.n_poses, len(shape.pairs) + len(shape.priors)
    truth, variances, errors = 9.0 * jitter(n, salt), variances_of(shape, salt), np.zeros(m)
    touched = [*map(tuple, shape.pairs.tolist()), *((pose,) for pose in shape.priors.tolist())]
    twins = next(([a, b] for a in range(m) for b in range(a) if set(touched[a]) == set(touched[b])), [])
    if twins:
        same = touched[twins[0]] == touched[twins[1]]
        errors[twins] = variances[twins] * (50.0, -50.0 if same else 50.0)
    return seen_from(shape, variances, truth, errors, truth + 1.8e-3 * (np.abs(jitter(n, salt + 0.6)) + 0.05))


def two_starts(case: Case) -> Case:
    """Make a case of a loop: the state, and another one, stacked."""
    x, graph = case
    return np.array([x, 1.5 - 0.5 * x[::-1]]), graph
