"""Slips of `gauss_newton_step` that solve no normal equations: steps that are typed in, guessed or taken downhill."""
# ruff: noqa: ARG001, D401 - a slip has the stage's signature, used or not, and its docstring states what is wrong

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from autograder.stages.slips.catalogue import Catalogue
from reference_solution import slam1d as right

if TYPE_CHECKING:
    from assignment.posegraph import PoseGraph

slip = Catalogue()


@slip()
def gradient_descent_step(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The step goes down the gradient by a fixed rate and does not use H.

    The gradient knows the direction but not the distance; which matrix knows how the cost bends?
    """
    J, f = right.jacobian(x, graph), right.residual(x, graph)
    _, b = right.normal_equations(J, right.information_matrix(graph), f)
    return -1e-3 * b


@slip()
def each_pose_corrected_alone(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """Every pose is corrected by the diagonal of H alone.

    When one pose moves, its neighbours have to follow: the entries beside the diagonal say by how much.
    """
    H, b = right.normal_equations(right.jacobian(x, graph), right.information_matrix(graph), right.residual(x, graph))
    step: np.ndarray = -b / np.diag(H)
    return step


@slip("S20")
def drift_spread_evenly(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The gap of the last edge is spread evenly over the poses between its ends.

    That is right only where all variances are equal, nothing else is out of place and there is one loop.
    """
    i, j = graph.edges[-1]
    gap = x[i] + graph.measurements[-1] - x[j]
    way = np.clip((np.arange(graph.n_poses) - i) / (j - i), 0.0, 1.0)
    step: np.ndarray = gap * way * abs(j - i) / (abs(j - i) + 1)
    step -= step[0]
    return step


@slip("S21")
def step_of_worked_example(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The step is the printed one of the worked example.

    Those five numbers hold for one graph from one start; solve the equations of the graph that you are given.
    """
    return np.array([0.0, -0.1, -0.2, -0.3, -0.4])


@slip()
def step_is_zero(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The step is zero.

    It is zero at the minimum only; does the state that you were given fit all measurements as well as it can?
    """
    return np.zeros(graph.n_poses)


@slip()
def step_to_the_origin(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The step leads to the origin.

    The measurements do not matter to this step; which of them should pull it where?
    """
    return -x


@slip()
def step_to_dead_reckoning(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The step leads back to dead reckoning.

    Dead reckoning is where the search may start: it has not heard the loop closures. Which state fits all factors best?
    """
    step: np.ndarray = graph.dead_reckoning() - x
    return step


WITHOUT_EQUATIONS = slip.entries
