"""Slips that are right on a walk near the origin with one prior: they narrow the domain, and fail beyond it."""
# ruff: noqa: D401 - the docstring of a slip states what is wrong

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from autograder.stages.slips.catalogue import Catalogue
from reference_solution import slam1d as right

if TYPE_CHECKING:
    from assignment.posegraph import PoseGraph

Pair = tuple[np.ndarray, np.ndarray]

residual = Catalogue()
jacobian = Catalogue()
information = Catalogue()
equations = Catalogue()
step = Catalogue()


@residual()
def residual_of_first_prior_only(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """Only the first prior has a row.

    A graph may have several priors, and each is a factor with a row of its own; count the rows that f should have.
    """
    return right.residual(x, graph)[: len(graph.edges) + 1]


@residual()
def prior_residuals_sorted_by_pose(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The rows of the priors are sorted by pose.

    The order of the rows is that of the lists in the graph, and priors may be listed in any order.
    """
    order = np.argsort(graph.priors, kind="stable")
    prior = x[graph.priors[order]] - graph.prior_means[order]
    return np.concatenate([right.residual(x, graph)[: len(graph.edges)], prior])


@residual()
def prior_means_kept_by_pose(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """Of two priors on one pose, the mean of the last stands for both.

    One pose may carry several priors. A dictionary by pose has room for one: what happens to the others in it?
    """
    means = dict(zip(graph.priors.tolist(), graph.prior_means.tolist(), strict=True))
    prior = [x[pose] - means[pose] for pose in graph.priors.tolist()]
    return np.concatenate([right.residual(x, graph)[: len(graph.edges)], prior])


@residual()
def small_residuals_set_to_zero(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """Rows of f below 5 cm are set to 0.

    Near the minimum all rows are small, and they are what the last step is made of; nothing says how small is nothing.
    """
    f = right.residual(x, graph)
    return np.where(np.abs(f) < 0.05, 0.0, f)


@jacobian()
def jacobian_of_first_prior_only(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """J has a row for the first prior only.

    A graph may have several priors, and J has a row for every row of f; which shape should it have?
    """
    return right.jacobian(x, graph)[: len(graph.edges) + 1]


@jacobian()
def prior_rows_sorted_by_pose(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The rows of the priors in J are sorted by pose.

    Row r of f and row r of J belong to one factor; priors may be listed in any order, and their rows follow the list.
    """
    J = right.jacobian(x, graph)
    J[len(graph.edges) :] = 0.0
    J[np.arange(len(graph.edges), len(J)), np.sort(graph.priors)] = 1.0
    return J


@jacobian()
def second_prior_row_of_a_pose_empty(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """A second prior on the same pose has an empty row in J.

    One pose may carry several priors. Each is a factor that depends on this pose, however many there are before it.
    """
    J = right.jacobian(x, graph)
    for row, pose in enumerate(graph.priors.tolist()):
        if pose in graph.priors[:row]:
            J[len(graph.edges) + row] = 0.0
    return J


@information()
def weights_of_first_prior_only(graph: PoseGraph) -> np.ndarray:
    """Omega has a weight for the first prior only.

    A graph may have several priors, and each comes with a variance of its own; how many factors are there to weigh?
    """
    m = len(graph.edges) + 1
    return right.information_matrix(graph)[:m, :m]


@information()
def prior_weights_sorted_by_pose(graph: PoseGraph) -> np.ndarray:
    """The weights of the priors are sorted by pose.

    A weight belongs to the factor in its row; priors may be listed in any order, and their weights follow the list.
    """
    order = np.argsort(graph.priors, kind="stable")
    return np.diag(1.0 / np.concatenate([graph.edge_variances, graph.prior_variances[order]]))


@information()
def prior_variances_kept_by_pose(graph: PoseGraph) -> np.ndarray:
    """Of two priors on one pose, the variance of the last stands for both.

    One pose may carry several priors. A dictionary by pose has room for one: what happens to the others in it?
    """
    variances = dict(zip(graph.priors.tolist(), graph.prior_variances.tolist(), strict=True))
    prior = [variances[pose] for pose in graph.priors.tolist()]
    return np.diag(1.0 / np.concatenate([graph.edge_variances, prior]))


@information()
def variances_lifted_to_a_floor(graph: PoseGraph) -> np.ndarray:
    """Variances below 1e-4 are lifted to 1e-4.

    A variance is never 0 here, and a good laser measures to the millimetre: who is that certain weighs that much.
    """
    variances = np.concatenate([graph.edge_variances, graph.prior_variances])
    return np.diag(1.0 / np.maximum(variances, 1e-4))


@equations(minimum_poses=1)
def large_residuals_cut(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """Residuals beyond 50 m are cut to 50 m before b is formed.

    A residual is large where the state is far from the minimum, and b must say how far; what is it a gradient of?
    """
    return right.normal_equations(J, omega, np.clip(f, -50.0, 50.0))


@equations(minimum_poses=1)
def weights_kept_in_a_range(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """Weights are kept between 0.01 and 5000.

    Variances differ by powers of ten, and so do their weights; who decides that one measurement may not count more?
    """
    return right.normal_equations(J, np.diag(np.clip(np.diag(omega), 0.01, 5000.0)), f)


@step()
def short_step_set_to_zero(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """A step below 1 mm is set to 0.

    One step of a linear problem ends at the minimum, however short it is; whether it is worth taking is for the caller.
    """
    dx: np.ndarray = right.gauss_newton_step(x, graph)
    return dx if np.abs(dx).max() > 1e-3 else np.zeros(len(dx))


@step()
def step_cut_to_50_m(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """No pose moves by more than 50 m in one step.

    The problem is linear: one step ends at the minimum from wherever it begins, also from far away.
    """
    cut: np.ndarray = np.clip(right.gauss_newton_step(x, graph), -50.0, 50.0)
    return cut


@step()
def weak_directions_cut_off(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """What a pseudoinverse takes for singular does not move.

    A weak prior makes an eigenvalue of H small, and it is no noise: H has an inverse where each part has a prior.
    """
    H, b = right.normal_equations(right.jacobian(x, graph), right.information_matrix(graph), right.residual(x, graph))
    dx: np.ndarray = np.linalg.pinv(H, rcond=1e-4) @ -b
    return dx


@step(minimum_poses=3)
def only_first_part_moves(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """Only the poses that edges join to the first prior move.

    A graph may have several parts, and each is held by a prior of its own; no walk from one pose reaches them all.
    """
    moves = np.arange(graph.n_poses) == graph.priors[0]
    for _ in range(graph.n_poses):
        for i, j in graph.edges:
            moves[i] = moves[j] = moves[i] or moves[j]
    return np.where(moves, right.gauss_newton_step(x, graph), 0.0)


RESIDUAL, JACOBIAN, INFORMATION = residual.entries, jacobian.entries, information.entries
EQUATIONS, STEP = equations.entries, step.entries
