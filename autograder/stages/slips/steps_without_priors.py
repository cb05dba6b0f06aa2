"""Slips of `gauss_newton_step` that leave the priors out, and what stands in their place."""
# ruff: noqa: D401 - the docstring of a slip states what is wrong

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from autograder.stages.slips.catalogue import Catalogue
from autograder.stages.slips.step_patterns import (
    of_singular_equations,
    priors_replaced_by_pose_0_at_0,
    priors_replaced_by_pose_0_held,
)
from reference_solution import slam1d as right

if TYPE_CHECKING:
    from assignment.posegraph import PoseGraph

slip = Catalogue()


@slip("S17, H17")
def prior_left_out_shortest_step(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The prior is left out, and of all steps that fit the edges the shortest is taken.

    Measured differences cannot say where the whole chain stands. Which factor can? A pseudo-inverse hides the question.
    """
    k = len(graph.edges)
    J, omega, f = right.jacobian(x, graph), right.information_matrix(graph), right.residual(x, graph)
    H, b = right.normal_equations(J[:k], omega[:k, :k], f[:k])
    step: np.ndarray = np.linalg.pinv(H, rcond=1e-10) @ -b
    return step


@slip(pattern=priors_replaced_by_pose_0_held)
def h_entry_in_place_of_priors(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The priors are left out: a number in the first entry of H, or a row taken out, holds pose 0 where it starts.

    A prior brings a pose, a mean and a weight, to H and to b alike; a number added to H brings no belief.
    """
    k = len(graph.edges)
    J, omega, f = right.jacobian(x, graph), right.information_matrix(graph), right.residual(x, graph)
    H, b = right.normal_equations(J[:k], omega[:k, :k], f[:k])
    H[0, 0] += 1.0
    try:
        return np.linalg.solve(H, -b)
    except np.linalg.LinAlgError:  # a graph in several parts needs more than one entry
        return np.zeros(graph.n_poses)


@slip(pattern=priors_replaced_by_pose_0_at_0)
def pose_0_at_0_in_place_of_priors(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The priors are left out, and pose 0 is put at 0 instead.

    That is right only while one prior says just this of pose 0; which pose is believed where is written in the graph.
    """
    k = len(graph.edges)
    J, omega, f = right.jacobian(x, graph), right.information_matrix(graph), right.residual(x, graph)
    H, b = right.normal_equations(J[:k], omega[:k, :k], f[:k])
    H[0, 0] += 1.0
    try:
        step: np.ndarray = np.linalg.solve(H, -b)
    except np.linalg.LinAlgError:  # a graph in several parts has more poses to hold
        return np.zeros(graph.n_poses)
    step -= step[0] + x[0]
    return step


@slip("S18, H17", pattern=of_singular_equations)
def prior_left_out_singular(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The prior is left out, and a singular H is solved all the same.

    A solver need not complain: rounding can make H just invertible, and the chain lands anywhere. What should hold it?
    """
    k = len(graph.edges)
    J, omega, f = right.jacobian(x, graph), right.information_matrix(graph), right.residual(x, graph)
    H, b = right.normal_equations(J[:k], omega[:k, :k], f[:k])
    try:
        return np.linalg.solve(H, -b)
    except np.linalg.LinAlgError:  # only where the elimination meets an exact 0
        return np.zeros(graph.n_poses)


WITHOUT_PRIORS = slip.entries
