"""1D SLAM by weighted least squares: your work.

The handout (README.md) explains every function. `python self_check.py` tells how far you are.
Hand in this file, or the notebook slam1d.ipynb, not both.
"""

from __future__ import annotations

import numpy as np
from posegraph import PoseGraph, Ranging

# Your own problem. Marks use the numbers on record, so there is nothing to gain by editing them.
my_graph = PoseGraph(
    n_poses=5,
    edges=np.array([(0, 1), (1, 2), (2, 3), (3, 4), (0, 4)]),
    measurements=np.array([1.1, 1.0, 1.1, -2.7, 0.0]),
    edge_variances=np.array([0.01, 0.01, 0.01, 0.01, 0.01]),
    priors=np.array([0]),
    prior_means=np.array([0.0]),
    prior_variances=np.array([0.001]),
)
my_start = np.array([0.0, 1.1, 2.1, 3.2, 0.5])
my_start.setflags(write=False)  # x += dx would move it; write x = x + dx


def residual(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """Stack what every factor says is wrong with the state x: the vector f.

    The row of an edge is where the edge puts pose j, minus where the state puts it: x_i + u_ij - x_j.
    The row of a prior is where the state puts pose i, minus the mean: x_i - mu_i.

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
    raise NotImplementedError("residual is not finished yet: replace this line by your code.")


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
    raise NotImplementedError("jacobian is not finished yet: replace this line by your code.")


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
    raise NotImplementedError("information_matrix is not finished yet: replace this line by your code.")


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
    raise NotImplementedError("normal_equations is not finished yet: replace this line by your code.")


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
    raise NotImplementedError("gauss_newton_step is not finished yet: replace this line by your code.")


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
    raise NotImplementedError("sparsity_pattern is not finished yet: replace this line by your code.")


def range_residual(x: np.ndarray, ranging: Ranging) -> np.ndarray:
    """Compare distances to a beacon beside the line with the measured ranges.

    Pose x_i stands at (x_i, 0) and the beacon at (b0, b1). A row is the distance between them,
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
    raise NotImplementedError("range_residual is not finished yet: replace this line by your code.")


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
    raise NotImplementedError("range_jacobian is not finished yet: replace this line by your code.")


# Question 2: a (4, n) array, its rows the iterates x^(0), x^(1), x^(2), x^(3) for my_graph from my_start.
iterates = None

# Question 3: the letter of the choice that you pick, for example "A".
conclusion = None

# Questions 2 and 3 in your own words, as texts: written_2 = """I see that ..."""
written_2 = None
written_3 = None
