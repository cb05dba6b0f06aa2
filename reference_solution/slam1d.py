"""1D SLAM by weighted least squares."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:  # only for readers and type checkers: this module runs without it
    from assignment.posegraph import PoseGraph, Ranging


def residual(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """Stack what every factor says is wrong with the state x: the vector f.

    A between factor from pose i to pose j predicts x_j by the motion model x_i + u_ij, so its row
    is x_i + u_ij - x_j. A prior factor on pose k with mean p has the row x_k - p.

    Parameters
    ----------
    x : (n,) float array
        Positions of the poses [m].
    graph : PoseGraph
        The problem; its n poses, k edges and p priors.

    Returns
    -------
    (m,) float array
        f [m], m = k + p: the edges in the given order, then the priors in the given order.

    Examples
    --------
    >>> from posegraph import PoseGraph
    >>> graph = PoseGraph(2, [(0, 1)], [1.5], [0.04], [0], [3.0], [0.001])
    >>> residual(np.array([4.0, 6.0]), graph)
    array([-0.5,  1. ])
    """
    i, j = graph.edges.T
    between = x[i] + graph.measurements - x[j]
    prior = x[graph.priors] - graph.prior_means
    return np.concatenate([between, prior])


def jacobian(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """Differentiate the residual: J[r, c] = df_r / dx_c.

    Parameters
    ----------
    x : (n,) float array
        Positions of the poses [m], where the derivative is taken.
    graph : PoseGraph
        The problem; its n poses, k edges and p priors.

    Returns
    -------
    (m, n) float array
        J [no unit]; the rows in the order of f, a column for every pose.

    Examples
    --------
    >>> from posegraph import PoseGraph
    >>> graph = PoseGraph(2, [(0, 1)], [1.5], [0.04], [0], [3.0], [0.001])
    >>> jacobian(np.array([4.0, 6.0]), graph)
    array([[ 1., -1.],
           [ 1.,  0.]])
    """
    k = len(graph.edges)
    i, j = graph.edges.T
    J = np.zeros((graph.n_factors, graph.n_poses))
    J[np.arange(k), i] = 1.0
    J[np.arange(k), j] = -1.0
    J[np.arange(k, graph.n_factors), graph.priors] = 1.0
    return J


def information_matrix(graph: PoseGraph) -> np.ndarray:
    """Weigh the factors: Omega, the inverse of the covariance of the measurements.

    The measurements are independent, so their covariance is diagonal: the variances of the edges,
    then those of the priors. A factor that is more certain weighs more.

    Parameters
    ----------
    graph : PoseGraph
        The problem; its n poses, k edges and p priors.

    Returns
    -------
    (m, m) float array
        Omega [1/m^2], diagonal; the rows in the order of f.

    Examples
    --------
    >>> from posegraph import PoseGraph
    >>> graph = PoseGraph(2, [(0, 1)], [1.5], [0.04], [0], [3.0], [0.001])
    >>> information_matrix(graph)
    array([[  25.,    0.],
           [   0., 1000.]])
    """
    variances = np.concatenate([graph.edge_variances, graph.prior_variances])
    return np.diag(1.0 / variances)


def normal_equations(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Form H = J^T Omega J and b = J^T Omega f.

    They are half the Hessian and half the gradient of the cost F(x) = f(x)^T Omega f(x). (Texts
    with a factor 1/2 in F have the same H and b, and so the same step.)

    Parameters
    ----------
    J : (m, n) float array
        Jacobian of the residual [no unit].
    omega : (m, m) float array
        Information matrix of the measurements [1/m^2].
    f : (m,) float array
        Residual [m].

    Returns
    -------
    H : (n, n) float array
        Information matrix of the state [1/m^2].
    b : (n,) float array
        Half the gradient of the cost [1/m].

    Examples
    --------
    >>> J = np.array([[1.0, -1.0], [1.0, 0.0]])
    >>> H, b = normal_equations(J, np.diag([25.0, 1000.0]), np.array([-0.5, 1.0]))
    >>> H
    array([[1025.,  -25.],
           [ -25.,   25.]])
    >>> b
    array([987.5,  12.5])
    """
    H = J.T @ omega @ J
    b = J.T @ omega @ f
    return H, b


def gauss_newton_step(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """Solve the normal equations H dx = -b for the step from x towards the minimum of the cost.

    Parameters
    ----------
    x : (n,) float array
        Positions of the poses [m], where the step begins.
    graph : PoseGraph
        The problem; its n poses, k edges and p priors.

    Returns
    -------
    (n,) float array
        dx [m]; the next state is x + dx.

    Examples
    --------
    >>> from posegraph import PoseGraph
    >>> graph = PoseGraph(2, [(0, 1)], [1.5], [0.04], [0], [3.0], [0.001])
    >>> gauss_newton_step(np.array([4.0, 6.0]), graph).round(12)
    array([-1. , -1.5])
    """
    f = residual(x, graph)
    J = jacobian(x, graph)
    H, b = normal_equations(J, information_matrix(graph), f)
    return np.linalg.solve(H, -b)


def sparsity_pattern(graph: PoseGraph) -> tuple[np.ndarray, np.ndarray]:
    """Mark where J and H can differ from 0, from the list of factors alone.

    A factor's row of J has an entry for each pose that the factor touches. Two poses share an
    entry of H when one factor touches both; every pose that any factor touches has its diagonal
    entry. No measurement, variance or state is needed.

    Parameters
    ----------
    graph : PoseGraph
        The problem; its n poses, k edges and p priors.

    Returns
    -------
    J_mask : (m, n) bool array
        True where J has an entry; the rows in the order of f.
    H_mask : (n, n) bool array
        True where H has an entry.

    Examples
    --------
    >>> from posegraph import PoseGraph
    >>> graph = PoseGraph(3, [(0, 1), (1, 2)], [1.5, 1.0], [0.04, 0.04], [0], [3.0], [0.001])
    >>> J_mask, H_mask = sparsity_pattern(graph)
    >>> J_mask.astype(int)
    array([[1, 1, 0],
           [0, 1, 1],
           [1, 0, 0]])
    >>> H_mask.astype(int)
    array([[1, 1, 0],
           [1, 1, 1],
           [0, 1, 1]])
    """
    rows, k = np.arange(graph.n_factors), len(graph.edges)
    J_mask = np.zeros((graph.n_factors, graph.n_poses), dtype=bool)
    J_mask[rows[:k, None], graph.edges] = True
    J_mask[rows[k:], graph.priors] = True
    H_mask = J_mask.T @ J_mask  # of truth values: some factor touches both
    return J_mask, H_mask


def range_residual(x: np.ndarray, ranging: Ranging) -> np.ndarray:
    """Compare distances to a beacon beside the line with the measured ranges.

    Pose x_k stands at (x_k, 0) and the beacon at (b0, b1). A row is the distance between them,
    by Pythagoras, minus the measured range.

    Parameters
    ----------
    x : (n,) float array
        Positions of the poses [m].
    ranging : Ranging
        The beacon, and the pose and range of each of q measurements.

    Returns
    -------
    (q,) float array
        f [m]; the measurements in the given order.

    Examples
    --------
    >>> from posegraph import Ranging
    >>> range_residual(np.array([0.0, 6.0]), Ranging([3.0, 4.0], [1, 0], [4.5, 5.0], [0.01, 0.01]))
    array([0.5, 0. ])
    """
    distance = np.hypot(x[ranging.poses] - ranging.beacon[0], ranging.beacon[1])
    f: np.ndarray = distance - ranging.ranges
    return f


def range_jacobian(x: np.ndarray, ranging: Ranging) -> np.ndarray:
    """Differentiate the range residual: J[r, c] = df_r / dx_c. It depends on x.

    Parameters
    ----------
    x : (n,) float array
        Positions of the poses [m], where the derivative is taken.
    ranging : Ranging
        The beacon, and the pose and range of each of q measurements.

    Returns
    -------
    (q, n) float array
        J [no unit]; the rows in the order of f, a column for every pose.

    Examples
    --------
    >>> from posegraph import Ranging
    >>> range_jacobian(np.array([0.0, 6.0]), Ranging([3.0, 4.0], [1, 0], [4.5, 5.0], [0.01, 0.01]))
    array([[ 0. ,  0.6],
           [-0.6,  0. ]])
    """
    ahead = x[ranging.poses] - ranging.beacon[0]
    J = np.zeros((len(ranging.poses), len(x)))
    J[np.arange(len(ranging.poses)), ranging.poses] = ahead / np.hypot(ahead, ranging.beacon[1])
    return J
