"""Slips of `gauss_newton_step`: what comes instead of dx, each as one whole wrong step.

Merged, because they are the same numbers: H1 followed by a right solution (S1); a step that returns x + dx, and one
with b taken at x = 0 (both H18); H17 solved by pseudo-inverse or least squares (S17). T3, the in-place `x += dx`,
returns the right dx: it is remarked on as a changed input.
"""
# ruff: noqa: D401 - the docstring of a slip states what is wrong

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from autograder.stages.slips import narrow, wrong_products
from autograder.stages.slips.catalogue import Catalogue
from autograder.stages.slips.patterns import rounded
from autograder.stages.slips.step_patterns import (
    damped,
    held_by_a_number,
    of_single_precision,
    step_sizes,
)
from autograder.stages.slips.steps_without_equations import WITHOUT_EQUATIONS
from autograder.stages.slips.steps_without_priors import WITHOUT_PRIORS
from reference_solution import slam1d as right

if TYPE_CHECKING:
    from assignment.posegraph import PoseGraph

slip = Catalogue()


@slip("H15")
def prior_weight_one_in_h(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The prior enters H with the weight 1 instead of its own.

    Adding 1 to the diagonal makes H invertible, but b speaks of the prior with another certainty; both must agree.
    """
    k = len(graph.edges)
    omega, omega_of_H = right.information_matrix(graph), right.information_matrix(graph)
    omega_of_H[k:, k:] = np.eye(len(graph.priors))
    J = right.jacobian(x, graph)
    H, _ = right.normal_equations(J, omega_of_H, right.residual(x, graph))
    _, b = right.normal_equations(J, omega, right.residual(x, graph))
    return np.linalg.solve(H, -b)


@slip("H16")
def prior_missing_in_b(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The prior enters H but not b.

    H says how firmly the prior holds its pose, b how far the pose is from it; at the start this distance may be 0.
    """
    f = right.residual(x, graph)
    f[len(graph.edges) :] = 0.0
    H, b = right.normal_equations(right.jacobian(x, graph), right.information_matrix(graph), f)
    return np.linalg.solve(H, -b)


@slip("H18")
def position_returned_as_step(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The new position is returned instead of the step that leads to it.

    It happens by returning x + dx, and also by evaluating f at 0 instead of at x. From where does your step begin?
    """
    f = right.residual(np.zeros(graph.n_poses), graph)
    H, b = right.normal_equations(right.jacobian(x, graph), right.information_matrix(graph), f)
    return np.linalg.solve(H, -b)


@slip("S1, H1")
def step_has_opposite_sign(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The step leads away from the minimum.

    b points uphill; where does the minus of the normal equations stand in your code, and does it stand there once?
    """
    return -right.gauss_newton_step(x, graph)


@slip("S4")
def step_half_as_long(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The step is half as long as it should be.

    A learning rate belongs to gradient descent, which knows no H. What does H know that makes it unnecessary?
    """
    return 0.5 * right.gauss_newton_step(x, graph)


@slip()
def step_twice_as_long(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The step is twice as long as it should be.

    The square of the cost brings a factor 2 to the gradient and to the Hessian alike; keep it in both or in neither.
    """
    return 2.0 * right.gauss_newton_step(x, graph)


@slip(pattern=held_by_a_number)
def number_added_to_first_entry_of_h(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """A number is added to the first entry of H, beside the priors.

    It holds pose 0 where it starts, as if that were believed; H has all that the priors say without it.
    """
    H, b = right.normal_equations(right.jacobian(x, graph), right.information_matrix(graph), right.residual(x, graph))
    H[0, 0] += 1000.0
    return np.linalg.solve(H, -b)


@slip("S5", pattern=damped)
def step_damped(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """A small number is added to the diagonal of H before solving.

    Damping is for problems that are not linear or not determined; here it only keeps the step from arriving.
    """
    H, b = right.normal_equations(right.jacobian(x, graph), right.information_matrix(graph), right.residual(x, graph))
    return np.linalg.solve(H + 1e-3 * np.eye(graph.n_poses), -b)


@slip()
def h_inverted_entry_by_entry(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """H is inverted entry by entry.

    The inverse of a matrix is not the matrix of inverses; which system of equations has the step as its solution?
    """
    H, b = right.normal_equations(right.jacobian(x, graph), right.information_matrix(graph), right.residual(x, graph))
    with np.errstate(divide="ignore", invalid="ignore"):
        step: np.ndarray = (1.0 / H) @ -b
    return step


@slip("S9, S10", pattern=rounded(right.gauss_newton_step, step_sizes))
def step_rounded(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The step is rounded.

    A few decimals look like enough on paper; the next step starts where this one ends and sees what is missing.
    """
    return right.gauss_newton_step(x, graph).round(4)


@slip("S11")
def pose_0_clamped_to_origin(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """Pose 0 is put at 0 after the step.

    Where pose 0 ends up is for the priors to say, and they may believe something else, or speak of another pose.
    """
    step = right.gauss_newton_step(x, graph)
    step[0] = -x[0]
    return step


@slip("S12")
def pose_0_held_at_its_start(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """Pose 0 is not allowed to move: its row and column are taken out.

    That treats the start of pose 0 as certain; it is a guess like the others, and only the prior says how good.
    """
    H, b = right.normal_equations(right.jacobian(x, graph), right.information_matrix(graph), right.residual(x, graph))
    return np.concatenate([[0.0], np.linalg.solve(H[1:, 1:], -b[1:])])


@slip("S13")
def chain_shifted_to_origin(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The whole chain is shifted after the step so that pose 0 stands at 0.

    The priors say where the chain stands, and the step has heard them already; a shift afterwards overrules them.
    """
    arrived = x + right.gauss_newton_step(x, graph)
    step: np.ndarray = arrived - arrived[0] - x
    return step


@slip("S15")
def step_without_weights(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The step comes from least squares without weights.

    A solver that is given J and f alone treats all rows alike; how does it learn that some are more certain?
    """
    step: np.ndarray = np.linalg.lstsq(right.jacobian(x, graph), -right.residual(x, graph), rcond=None)[0]
    return step


@slip("S16")
def step_with_squared_weights(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The rows are scaled by their weights before least squares, so that every weight is squared.

    A least-squares solver squares what it is given; by what must a row be scaled so that its weight comes out right?
    """
    J, omega, f = right.jacobian(x, graph), right.information_matrix(graph), right.residual(x, graph)
    step: np.ndarray = np.linalg.lstsq(omega @ J, -omega @ f, rcond=None)[0]
    return step


@slip(minimum_poses=3)
def loops_left_out(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The loop closures are left out of the step.

    Without them the chain hangs on the odometry alone; what do they know that the odometry does not?
    """
    i, j = graph.edges.T
    heard = np.concatenate([np.abs(j - i) == 1, np.ones(len(graph.priors), dtype=bool)])
    root = np.sqrt(right.information_matrix(graph))[heard][:, heard]
    J, f = right.jacobian(x, graph)[heard], right.residual(x, graph)[heard]
    step: np.ndarray = np.linalg.lstsq(root @ J, -root @ f, rcond=None)[0]
    return step


@slip("S24", pattern=of_single_precision)
def step_in_single_precision(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The whole step is worked out in single precision.

    Half of the digits are gone, and an uneven H loses more; what type do your arrays have?
    """
    J, single = right.jacobian(x, graph).astype(np.float32), x.astype(np.float32)
    i, j = graph.edges.T
    between = single[i] + graph.measurements.astype(np.float32) - single[j]
    f = np.concatenate([between, single[graph.priors] - graph.prior_means.astype(np.float32)])
    variances = np.concatenate([graph.edge_variances, graph.prior_variances]).astype(np.float32)
    H, b = right.normal_equations(J, np.diag(1.0 / variances), f)
    return np.linalg.solve(H, -b)


@slip("T1")
def b_always_at_the_start(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The vector b is that of dead reckoning, whatever state is given.

    f, and with it b, changes when the robot moves; work it out again at the state that you were given.
    """
    f = right.residual(graph.dead_reckoning(), graph)
    H, b = right.normal_equations(right.jacobian(x, graph), right.information_matrix(graph), f)
    return np.linalg.solve(H, -b)


@slip("T5")
def odometry_taken_from_state(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The measurements between neighbours are replaced by the differences of the state.

    A measurement does not change when the estimate does; if it is made to agree, it has nothing left to say.
    """
    i, j = graph.edges.T
    f = right.residual(x, graph)
    f[: len(i)][np.abs(j - i) == 1] = 0.0
    H, b = right.normal_equations(right.jacobian(x, graph), right.information_matrix(graph), f)
    return np.linalg.solve(H, -b)


SLIPS = (*slip.entries, *WITHOUT_PRIORS, *WITHOUT_EQUATIONS, *narrow.STEP, *wrong_products.STEP)
