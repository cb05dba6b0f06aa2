"""Slips of `jacobian`: what comes instead of J.

A loop is what a student takes for one: an edge between poses that are not neighbours.
"""
# ruff: noqa: ARG001, D401 - a slip has the stage's signature, used or not, and its docstring states what is wrong

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from autograder.stages.slips import narrow
from autograder.stages.slips.catalogue import Catalogue
from autograder.stages.slips.patterns import small_difference
from reference_solution import slam1d as right

if TYPE_CHECKING:
    from assignment.posegraph import PoseGraph

slip = Catalogue()


@slip("J1")
def jacobian_of_worked_example(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """J is the printed matrix of the worked example.

    Those numbers hold for one graph; which rows and columns another graph needs is written in its edges and priors.
    """
    return np.array(
        [[1, -1, 0, 0, 0], [0, 1, -1, 0, 0], [0, 0, 1, -1, 0], [0, 0, 0, 1, -1], [1, 0, 0, 0, -1], [1, 0, 0, 0, 0]]
    )


@slip("J2")
def between_rows_opposite_sign(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The rows of all between factors have the opposite sign.

    Differentiate your own row of f: what happens to it when the pose at which the edge begins moves forward?
    """
    J = right.jacobian(x, graph)
    J[: len(graph.edges)] *= -1.0
    return J


@slip()
def prior_row_opposite_sign(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The prior's row has the opposite sign.

    Move the pose that carries the prior forward: does its row of f grow or shrink?
    """
    J = right.jacobian(x, graph)
    J[len(graph.edges) :] *= -1.0
    return J


@slip()
def jacobian_opposite_sign(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """Every row of J has the opposite sign.

    J is the derivative of f as the handout writes it, not of its negative; f and J must agree.
    """
    return -right.jacobian(x, graph)


@slip("J3")
def jacobian_transposed(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """J is transposed.

    A row belongs to a factor and a column to a pose; the formula for H transposes it for you.
    """
    return right.jacobian(x, graph).T


@slip("J4")
def prior_row_missing(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The rows of the priors are missing.

    J has as many rows as f; without the priors the whole chain could slide along the line for free.
    """
    return right.jacobian(x, graph)[: len(graph.edges)]


@slip()
def prior_row_is_zero(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The prior's row is all zeros.

    The mean of a prior is a constant, but its row of f also holds a pose, and that one moves.
    """
    J = right.jacobian(x, graph)
    J[len(graph.edges) :] = 0.0
    return J


@slip("J6")
def prior_row_always_in_column_0(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The prior's row always has its entry in column 0.

    Any pose may carry a prior, and several may; which ones is written in the graph.
    """
    J = right.jacobian(x, graph)
    J[len(graph.edges) :] = 0.0
    J[len(graph.edges) :, 0] = 1.0
    return J


@slip("J7", minimum_poses=3)
def loop_row_spans_whole_chain(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The loop's row always has its entries in the first column and the last.

    A loop may close between any two poses, in either direction; which two is written in the graph.
    """
    J = right.jacobian(x, graph)
    for row, (i, j) in enumerate(graph.edges):
        if abs(j - i) > 1:
            J[row] = 0.0
            J[row, 0], J[row, -1] = 1.0, -1.0
    return J


@slip()  # a near relative of J7: here the place in the list, not the poses, makes a loop
def last_edge_row_spans_whole_chain(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The row of the last edge always has its entries in the first column and the last.

    Edges come in any order and there may be no loop or several; only the pair of poses says what an edge joins.
    """
    J = right.jacobian(x, graph)
    k = len(graph.edges)
    if k:
        J[k - 1] = 0.0
        J[k - 1, 0], J[k - 1, -1] = 1.0, -1.0
    return J


@slip(minimum_poses=3)
def loop_row_is_zero(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The loop's row is all zeros.

    A loop closure is a between factor like any other: its row of f changes when either of its poses moves.
    """
    J = right.jacobian(x, graph)
    for row, (i, j) in enumerate(graph.edges):
        if abs(j - i) > 1:
            J[row] = 0.0
    return J


@slip("J10")
def only_first_pose_differentiated(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """A between row has an entry only for the pose where the edge begins.

    Two unknowns stand in that row of f; differentiate with respect to each of them.
    """
    J = right.jacobian(x, graph)
    for row, (_, j) in enumerate(graph.edges):
        J[row, j] = 0.0
    return J


@slip()
def only_second_pose_differentiated(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """A between row has an entry only for the pose where the edge ends.

    The prediction itself begins at an unknown pose; differentiate with respect to that one too.
    """
    J = right.jacobian(x, graph)
    for row, (i, _) in enumerate(graph.edges):
        J[row, i] = 0.0
    return J


@slip()
def both_entries_plus_one(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """Both entries of a between row are +1.

    J is more than a table of who is joined to whom: one of the two poses enters its row of f with a minus.
    """
    J: np.ndarray = np.abs(right.jacobian(x, graph))
    return J


@slip()
def backward_edge_read_forward(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The row of an edge from a later pose to an earlier one is that of a forward edge.

    An edge has a direction: the pose where it begins has the same sign in every row, wherever its column stands.
    """
    J = np.zeros((graph.n_factors, graph.n_poses))
    for row, (i, j) in enumerate(graph.edges):
        J[row, min(i, j)], J[row, max(i, j)] = 1.0, -1.0
    for row, pose in enumerate(graph.priors, len(graph.edges)):
        J[row, pose] = 1.0
    return J


@slip()
def edges_read_as_chain(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The first rows join pose r and pose r + 1, whatever their edges say.

    The number of a row is its place in a list; the poses that it joins are written in the row itself.
    """
    J = right.jacobian(x, graph)
    for row in range(min(graph.n_poses - 1, len(graph.edges))):
        J[row] = 0.0
        J[row, row], J[row, row + 1] = 1.0, -1.0
    return J


@slip(minimum_poses=3)
def jacobian_rows_odometry_first(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The rows of the odometry come before those of the loops, whatever their order in the graph.

    Row r of f, J and Omega must speak of the same factor; the common order is that of the graph.
    """
    J = right.jacobian(x, graph)
    loop = np.abs(np.diff(graph.edges, axis=1)).ravel() > 1
    order = np.argsort(loop, kind="stable")
    return np.concatenate([J[order], J[len(order) :]])


@slip()
def jacobian_rows_priors_first(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The rows of the priors come first.

    Row r of f, J and Omega must speak of the same factor; the handout puts the edges before the priors.
    """
    return np.roll(right.jacobian(x, graph), len(graph.priors), axis=0)


@slip()
def second_prior_row_on_first_pose(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """Every prior's row has its entry in the column of the first prior.

    There may be several priors, and each is about a pose of its own.
    """
    J = right.jacobian(x, graph)
    J[len(graph.edges) :] = J[len(graph.edges)]
    return J


@slip()
def states_kept_in_derivative(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The entries of J are the poses' values instead of their coefficients.

    A derivative says how fast f changes, not how large it is: what is left of a term when you differentiate it?
    """
    J: np.ndarray = right.jacobian(x, graph) * x
    return J


@slip()
def jacobian_whitened(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The rows of J are divided by the standard deviations.

    That is the whitened Jacobian, a good thing elsewhere; here the weights live in Omega alone.
    """
    sigma = np.sqrt(np.concatenate([graph.edge_variances, graph.prior_variances]))
    J: np.ndarray = right.jacobian(x, graph) / sigma[:, None]
    return J


@slip()
def jacobian_is_the_gradient(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """J is the gradient of the cost, one number a pose.

    The cost has a gradient, f has a Jacobian: a row for every factor. The gradient is made from it later.
    """
    f, J = right.residual(x, graph), right.jacobian(x, graph)
    _, b = right.normal_equations(J, right.information_matrix(graph), f)
    return 2.0 * b


@slip()
def jacobian_is_the_adjacency_matrix(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """J is a table of poses against poses, with 1 where two are joined.

    A row of J belongs to a factor, not to a pose; poses meet poses only in H.
    """
    A = np.zeros((graph.n_poses, graph.n_poses))
    for i, j in graph.edges:
        A[i, j] = A[j, i] = 1.0
    return A


@slip("J11", pattern=small_difference)
def difference_step_too_small(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """J is a finite difference with a step so small that rounding drowns it.

    The smaller the step, the fewer digits survive the subtraction. For a linear f, how small must the step be at all?
    """
    h = 1e-9
    J = np.zeros((graph.n_factors, graph.n_poses))
    for c in range(graph.n_poses):
        moved = x.copy()
        moved[c] += h
        J[:, c] = (right.residual(moved, graph) - right.residual(x, graph)) / h
    return J


SLIPS = (*slip.entries, *narrow.JACOBIAN)
