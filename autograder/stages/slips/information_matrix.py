"""Slips of `information_matrix`: what comes instead of Omega.

A loop is what a student takes for one: an edge between poses that are not neighbours.
"""
# ruff: noqa: ARG001, D401 - a slip has the stage's signature, used or not, and its docstring states what is wrong

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from autograder.stages.slips import narrow
from autograder.stages.slips.catalogue import Catalogue
from autograder.stages.slips.patterns import rounded, single_precision, weight_sizes
from reference_solution import slam1d as right

if TYPE_CHECKING:
    from assignment.posegraph import PoseGraph

slip = Catalogue()


@slip("W1")
def covariance_used_as_information(graph: PoseGraph) -> np.ndarray:
    """The variances themselves stand on the diagonal.

    That is the covariance, which grows with doubt; a weight should grow with certainty.
    """
    return np.diag(np.concatenate([graph.edge_variances, graph.prior_variances]))


@slip("W2")
def inverse_standard_deviation(graph: PoseGraph) -> np.ndarray:
    """The weights are inverse standard deviations.

    The residual enters the cost squared; the scale that it is measured against must be squared as well.
    """
    return np.diag(1.0 / np.sqrt(np.concatenate([graph.edge_variances, graph.prior_variances])))


@slip()
def standard_deviation_used_as_information(graph: PoseGraph) -> np.ndarray:
    """The standard deviations stand on the diagonal.

    Two things are off: what grows with doubt is no weight, and the cost is made of squares.
    """
    return np.diag(np.sqrt(np.concatenate([graph.edge_variances, graph.prior_variances])))


@slip("W3")
def variance_squared_again(graph: PoseGraph) -> np.ndarray:
    """The weights are inverse squares of the variances.

    The fields of the graph are variances, in square metres: they are squared already.
    """
    return np.diag(1.0 / np.concatenate([graph.edge_variances, graph.prior_variances]) ** 2)


@slip("W4")
def identity_used_as_information(graph: PoseGraph) -> np.ndarray:
    """Every factor has the weight 1.

    That is least squares without weights; a measurement with a small variance should count for more.
    """
    return np.eye(graph.n_factors)


@slip("W5")
def first_edge_variance_for_all_edges(graph: PoseGraph) -> np.ndarray:
    """Every edge is given the variance of the first one.

    They are equal in the worked example only; each measurement has a variance of its own.
    """
    edges = np.repeat(graph.edge_variances[:1], len(graph.edges))
    return np.diag(1.0 / np.concatenate([edges, graph.prior_variances]))


@slip("W6", minimum_poses=3)
def loop_given_odometry_variance(graph: PoseGraph) -> np.ndarray:
    """A loop is given the variance of the first edge between neighbours.

    Recognising a place is another instrument than counting wheel turns, and has a variance of its own.
    """
    i, j = graph.edges.T
    variances = graph.edge_variances.copy()
    odometry = np.abs(j - i) == 1
    if odometry.any():
        variances[~odometry] = variances[odometry][0]
    return np.diag(1.0 / np.concatenate([variances, graph.prior_variances]))


@slip("W7")
def weights_of_worked_example(graph: PoseGraph) -> np.ndarray:
    """Every edge has the weight 100 and every prior 1000.

    Those are the weights of the worked example; calculate them from the variances that you are given.
    """
    return np.diag([100.0] * len(graph.edges) + [1000.0] * len(graph.priors))


@slip()
def information_of_worked_example(graph: PoseGraph) -> np.ndarray:
    """Omega is the printed 6 x 6 matrix of the worked example.

    How many factors there are, and how certain each is, are properties of the graph; ask it.
    """
    return np.diag([100.0, 100.0, 100.0, 100.0, 100.0, 1000.0])


@slip("W8")
def prior_given_edge_weight(graph: PoseGraph) -> np.ndarray:
    """The prior is given the variance of the first edge.

    A belief about where a pose stands and a measured displacement are two things; each has a variance of its own.
    """
    priors = np.full(len(graph.priors), graph.edge_variances[0])
    return np.diag(1.0 / np.concatenate([graph.edge_variances, priors]))


@slip("W9")
def prior_variance_squared_again(graph: PoseGraph) -> np.ndarray:
    """The prior's weight is the inverse square of its variance.

    The field holds a variance, not a standard deviation: it is squared already.
    """
    return np.diag(1.0 / np.concatenate([graph.edge_variances, graph.prior_variances**2]))


@slip("W10")
def weights_priors_first(graph: PoseGraph) -> np.ndarray:
    """The weights of the priors come first.

    Row r of f, J and Omega must speak of the same factor; the handout puts the edges before the priors.
    """
    return np.diag(1.0 / np.concatenate([graph.prior_variances, graph.edge_variances]))


@slip(minimum_poses=3)
def weights_odometry_first(graph: PoseGraph) -> np.ndarray:
    """The weights of the odometry come before those of the loops, whatever their order in the graph.

    Row r of f, J and Omega must speak of the same factor; the common order is that of the graph.
    """
    loop = np.abs(np.diff(graph.edges, axis=1)).ravel() > 1
    order = np.argsort(loop, kind="stable")
    return np.diag(1.0 / np.concatenate([graph.edge_variances[order], graph.prior_variances]))


@slip("W12")  # the loop's part needs three poses; the prior's part shows from two
def weights_tuned_by_hand(graph: PoseGraph) -> np.ndarray:
    """The loops have the weight 5000 and the priors 10000.

    A weight is no knob to turn until the result looks right: it states how certain the measurement was.
    """
    i, j = graph.edges.T
    edges = np.where(np.abs(j - i) > 1, 5000.0, 1.0 / graph.edge_variances)
    return np.diag(np.concatenate([edges, np.full(len(graph.priors), 10000.0)]))


@slip()
def prior_made_certain(graph: PoseGraph) -> np.ndarray:
    """The priors have an enormous weight, as if they were exact.

    A prior is a belief with a variance like any measurement; it may give way where others disagree.
    """
    return np.diag(np.concatenate([1.0 / graph.edge_variances, np.full(len(graph.priors), 1e9)]))


@slip()
def prior_weight_missing(graph: PoseGraph) -> np.ndarray:
    """The weights of the priors are missing.

    Omega has a row for every row of f, and a prior is a factor too.
    """
    return np.diag(1.0 / graph.edge_variances)


@slip()
def second_prior_takes_first_variance(graph: PoseGraph) -> np.ndarray:
    """Every prior is given the variance of the first one.

    There may be several priors, and each has a certainty of its own.
    """
    priors = np.full(len(graph.priors), graph.prior_variances[0])
    return np.diag(1.0 / np.concatenate([graph.edge_variances, priors]))


@slip()
def weights_in_a_vector(graph: PoseGraph) -> np.ndarray:
    """The weights come as a vector instead of a matrix.

    The numbers may be right, but Omega stands between two matrices in the formula for H: what shape must it have?
    """
    return np.diag(right.information_matrix(graph))


@slip()
def weights_halved(graph: PoseGraph) -> np.ndarray:
    """All weights are halved.

    A factor 1/2 stands in the exponent of the normal density, before the square; it is no part of the information.
    """
    return np.diag(0.5 / np.concatenate([graph.edge_variances, graph.prior_variances]))


@slip()
def weights_normalised(graph: PoseGraph) -> np.ndarray:
    """The weights are scaled so that they add up to 1.

    The step does not notice, but Omega has a unit: it says how certain each single measurement is.
    """
    omega = right.information_matrix(graph)
    omega /= np.trace(omega)
    return omega


@slip()
def weights_in_whole_numbers(graph: PoseGraph) -> np.ndarray:
    """The weights are stored in an array of integers, which cuts the decimals off.

    An array keeps the type it was made with; which type does yours have, and what becomes of a weight below 1 in it?
    """
    return right.information_matrix(graph).astype(int)


@slip()
def covariance_inverted_entry_by_entry(graph: PoseGraph) -> np.ndarray:
    """The covariance is inverted entry by entry, zeros beside the diagonal included.

    The inverse of a matrix is not the matrix of inverses; what stands where two measurements share no error?
    """
    with np.errstate(divide="ignore"):
        omega: np.ndarray = 1.0 / np.diag(np.concatenate([graph.edge_variances, graph.prior_variances]))
    return omega


@slip()
def weights_fill_the_matrix(graph: PoseGraph) -> np.ndarray:
    """Every entry of a row holds the row's weight, beside the diagonal too.

    An entry beside the diagonal would say that two measurements err together; ours are independent.
    """
    weights = np.diag(right.information_matrix(graph))
    return np.outer(weights, np.ones(len(weights)))


@slip()  # shows where there are more factors than poses: from two edges between two poses
def information_with_a_row_for_every_pose(graph: PoseGraph) -> np.ndarray:
    """Omega has a row for every pose.

    It weighs measurements, not poses: count the rows of f. How certain the poses are is told by H.
    """
    return right.information_matrix(graph)[: graph.n_poses, : graph.n_poses]


@slip(pattern=rounded(right.information_matrix, weight_sizes))
def information_rounded(graph: PoseGraph) -> np.ndarray:
    """The weights are rounded.

    Round what you print, never what you go on calculating with: a small weight loses most.
    """
    return np.round(right.information_matrix(graph), 2)


@slip("S24", pattern=single_precision(right.information_matrix, weight_sizes, terms=4))
def information_in_single_precision(graph: PoseGraph) -> np.ndarray:
    """The weights are worked out in single precision.

    The last decimals of a weight seem to matter little, but they come back in H; what type do your arrays have?
    """
    variances = np.concatenate([graph.edge_variances, graph.prior_variances]).astype(np.float32)
    return np.diag(1.0 / variances)


SLIPS = (*slip.entries, *narrow.INFORMATION)
