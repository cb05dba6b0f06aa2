"""Slips of `second_step`: steps after which there is something left to do, and steps that only pretend.

A function here is a `gauss_newton_step`. One that is wrong but consistent (weights squared or left out, pose 0 clamped
or the chain shifted to the origin) passes this stage and fails the one before, so it is not listed. T2, T6 and T7 of
the catalogue concern reported values, not steps.
"""
# ruff: noqa: ARG001, D401 - a slip has the stage's signature, used or not, and its docstring states what is wrong

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from autograder.stages.slips.catalogue import Catalogue
from autograder.stages.slips.patterns import rounded
from autograder.stages.slips.step_patterns import (
    damped,
    held_by_a_number,
    of_single_precision,
    priors_replaced_by_pose_0_held,
    step_sizes,
)
from autograder.stages.slips.wrong_products import SECOND
from reference_solution import slam1d as right

if TYPE_CHECKING:
    from assignment.posegraph import PoseGraph

slip = Catalogue()


@slip()
def jumps_to_the_origin(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The step is minus the state, so that every start ends at the origin.

    The second step is zero indeed, but for the wrong reason: which measurement had any say in where it ended?
    """
    return -x


@slip()
def jumps_to_a_fixed_target(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The step leads to a target that is written in the code.

    The point must come out of the measurements: change one of them, and it has to move.
    """
    target = np.resize([0.0, 1.0, 1.9, 2.9, 0.1], graph.n_poses)
    step: np.ndarray = target - x
    return step


@slip()
def jumps_to_dead_reckoning(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The step leads to dead reckoning.

    Dead reckoning does not listen to the loop closure: change what that one measured, and the point has to move.
    """
    step: np.ndarray = graph.dead_reckoning() - x
    return step


@slip()
def never_moves(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The step is zero everywhere.

    A zero step says that the minimum is reached. Two different starts cannot both be there.
    """
    return np.zeros(graph.n_poses)


@slip("S4")
def half_of_the_way_is_left(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The step is too short: half of the way is left after it.

    A learning rate belongs to methods that do not know the distance; H and b know it exactly when f is linear.
    """
    return 0.5 * right.gauss_newton_step(x, graph)


@slip()
def swings_past_the_minimum(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The step is twice too long: it swings past the minimum as far as it began before it.

    Somewhere a factor 2 stands in b alone or a factor 1/2 in H alone; they must be the same in both.
    """
    return 2.0 * right.gauss_newton_step(x, graph)


@slip("S1, H1")
def walks_away_from_the_minimum(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The step has the opposite sign: every step leads further away.

    Work out the cost before and after one step. Which sign of the step makes it fall?
    """
    return -right.gauss_newton_step(x, graph)


@slip("S5", pattern=damped)
def damping_leaves_a_rest(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """A small number on the diagonal of H keeps the step from arriving.

    The rest that the second step finds is no rounding: compare its size with 1e-16. What was added to H?
    """
    J, f = right.jacobian(x, graph), right.residual(x, graph)
    H, b = right.normal_equations(J, right.information_matrix(graph), f)
    return np.linalg.solve(H + 1e-3 * np.eye(graph.n_poses), -b)


@slip()
def creeps_down_the_gradient(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The step goes down the gradient by a fixed rate, so that many steps are needed.

    One step is enough when f is linear, but only for a method that uses how the cost bends.
    """
    J, f = right.jacobian(x, graph), right.residual(x, graph)
    _, b = right.normal_equations(J, right.information_matrix(graph), f)
    step: np.ndarray = -1e-3 * b
    return step


@slip(remembers=True)
def zero_when_called_again(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The second call for a graph answers zero without looking at the state.

    The second step is zero because the state is the minimum, not because it is the second; try it from another state.
    """
    memory = zero_when_called_again.__dict__
    last, memory["graph"] = memory.get("graph"), graph
    return np.zeros(graph.n_poses) if last == graph else right.gauss_newton_step(x, graph)


@slip("T1", remembers=True)
def old_b_used_again(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The second call for a graph uses the b of the first.

    That b belongs to the state at which it was worked out; after a step the state is another one.
    """
    memory = old_b_used_again.__dict__
    J, omega = right.jacobian(x, graph), right.information_matrix(graph)
    H, b = right.normal_equations(J, omega, right.residual(x, graph))
    if memory.get("graph") != graph:
        memory.update(graph=graph, b=b)
    return np.linalg.solve(H, -memory["b"])


@slip("T1")  # the same mistake without a memory: b from the start state instead of from the last call
def the_same_step_everywhere(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The step is the one from dead reckoning, whatever state is given.

    f changes with the state, and the step with it; where does your code take the state from?
    """
    f = right.residual(graph.dead_reckoning(), graph)
    H, b = right.normal_equations(right.jacobian(x, graph), right.information_matrix(graph), f)
    return np.linalg.solve(H, -b)


@slip("S9, S10", pattern=rounded(right.gauss_newton_step, step_sizes))
def rounded_step_stops_short(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The step is rounded and stops beside the minimum.

    The rest that the second step finds is no floating point noise: that has sixteen decimals.
    """
    return right.gauss_newton_step(x, graph).round(4)


@slip("H18")
def position_taken_for_a_step(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The function returns where to go, not how far: added to the state, it leads past.

    Is the addition of the state done twice, or is f evaluated at 0 instead of at x?
    """
    step: np.ndarray = x + right.gauss_newton_step(x, graph)
    return step


@slip("T5")
def odometry_measured_from_the_state(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The measurements between neighbours are replaced by the differences of the state.

    The odometry then agrees with every state, and the loop pulls it a little further at each step. What was measured?
    """
    i, j = graph.edges.T
    f = right.residual(x, graph)
    f[: len(i)][np.abs(j - i) == 1] = 0.0
    H, b = right.normal_equations(right.jacobian(x, graph), right.information_matrix(graph), f)
    return np.linalg.solve(H, -b)


@slip("S12")
def held_pose_keeps_its_start(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """Pose 0 is held where it starts, so that another start ends elsewhere.

    The prior says where the chain stands, and it says the same from every start; who holds pose 0 in your step?
    """
    J, f = right.jacobian(x, graph), right.residual(x, graph)
    H, b = right.normal_equations(J, right.information_matrix(graph), f)
    return np.concatenate([[0.0], np.linalg.solve(H[1:, 1:], -b[1:])])


@slip(pattern=priors_replaced_by_pose_0_held)
def number_in_h_holds_pose_0(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The priors are left out, and pose 0 stays where it starts, by a number in H or by a row taken out.

    From another start the chain ends elsewhere. Who says where it stands, and by what is it said in H and in b?
    """
    k = len(graph.edges)
    J, omega, f = right.jacobian(x, graph), right.information_matrix(graph), right.residual(x, graph)
    H, b = right.normal_equations(J[:k], omega[:k, :k], f[:k])
    H[0, 0] += 1.0
    try:
        return np.linalg.solve(H, -b)
    except np.linalg.LinAlgError:  # a graph in several parts needs more than one entry
        return np.zeros(graph.n_poses)


@slip(pattern=held_by_a_number)
def first_entry_of_h_leaves_a_rest(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """A number is added to the first entry of H, so that pose 0 does not come all the way.

    What does that number say about pose 0 that no factor of the graph says? Compare with the rows of f.
    """
    H, b = right.normal_equations(right.jacobian(x, graph), right.information_matrix(graph), right.residual(x, graph))
    H[0, 0] += 1000.0
    return np.linalg.solve(H, -b)


@slip("H16")
def prior_does_not_pull(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The prior makes H invertible but is missing in b, so that it holds the chain without pulling it.

    A chain that starts in the wrong place stays there. Which rows of f tell b how far off it is?
    """
    f = right.residual(x, graph)
    f[len(graph.edges) :] = 0.0
    H, b = right.normal_equations(right.jacobian(x, graph), right.information_matrix(graph), f)
    return np.linalg.solve(H, -b)


@slip("S17, H17")
def chain_floats_without_prior(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The prior is left out, so that the chain floats to another place from every start.

    Differences say nothing about where the whole chain stands; a pseudo-inverse only hides that an equation is missing.
    """
    k = len(graph.edges)
    J, omega, f = right.jacobian(x, graph), right.information_matrix(graph), right.residual(x, graph)
    H, b = right.normal_equations(J[:k], omega[:k, :k], f[:k])
    step: np.ndarray = np.linalg.pinv(H, rcond=1e-10) @ -b
    return step


@slip(minimum_poses=3)
def loop_has_no_effect(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The loop closures are left out: change what they measured, and the point does not move.

    The second step is zero, yet an instrument is not listened to. Which rows of f do your H and b contain?
    """
    i, j = graph.edges.T
    heard = np.concatenate([np.abs(j - i) == 1, np.ones(len(graph.priors), dtype=bool)])
    root = np.sqrt(right.information_matrix(graph))[heard][:, heard]
    J, f = right.jacobian(x, graph)[heard], right.residual(x, graph)[heard]
    step: np.ndarray = np.linalg.lstsq(root @ J, -root @ f, rcond=None)[0]
    return step


@slip("S24", pattern=of_single_precision)
def single_precision_leaves_a_rest(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The whole step is worked out in single precision, and the second step finds what was lost.

    A rest of 1e-7 is the noise of numbers with seven digits, not of those with sixteen; what type do your arrays have?
    """
    J, single = right.jacobian(x, graph).astype(np.float32), x.astype(np.float32)
    i, j = graph.edges.T
    between = single[i] + graph.measurements.astype(np.float32) - single[j]
    f = np.concatenate([between, single[graph.priors] - graph.prior_means.astype(np.float32)])
    variances = np.concatenate([graph.edge_variances, graph.prior_variances]).astype(np.float32)
    H, b = right.normal_equations(J, np.diag(1.0 / variances), f)
    return np.linalg.solve(H, -b)


SLIPS = (*slip.entries, *SECOND)
