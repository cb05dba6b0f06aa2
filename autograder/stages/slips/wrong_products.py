"""Slips of a step whose product is not the one that was meant: weights in H alone, an inverse multiplied by entries."""
# ruff: noqa: D401 - the docstring of a slip states what is wrong

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from autograder.stages.slips.catalogue import Catalogue
from reference_solution import slam1d as right

if TYPE_CHECKING:
    from assignment.posegraph import PoseGraph

step = Catalogue()
second = Catalogue()


@step()
def step_with_b_without_weights(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The step is made of an H with weights and a b without them.

    H and b come from the same cost: a factor that holds its poses firmly must also pull firmly.
    """
    J, f = right.jacobian(x, graph), right.residual(x, graph)
    H, _ = right.normal_equations(J, right.information_matrix(graph), f)
    return np.linalg.solve(H, -J.T @ f)


@step()
def inverse_multiplied_by_entries(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The inverse of H is multiplied with b entry by entry, which leaves a matrix.

    A step has one number for each pose; which sign multiplies a matrix and a vector, and which one just their entries?
    """
    H, b = right.normal_equations(right.jacobian(x, graph), right.information_matrix(graph), right.residual(x, graph))
    step: np.ndarray = np.linalg.inv(H) * -b
    return step


@second()
def b_without_weights_leaves_a_rest(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The step is made of an H with weights and a b without them, and does not arrive.

    Where is a step zero: where b is zero, or where the whole cost is smallest? With one cost for both it is the same.
    """
    J, f = right.jacobian(x, graph), right.residual(x, graph)
    H, _ = right.normal_equations(J, right.information_matrix(graph), f)
    return np.linalg.solve(H, -J.T @ f)


@second()
def matrix_taken_for_a_step(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The function returns a matrix: the inverse of H, multiplied with b entry by entry.

    How many numbers does a step have? The sum over each row is what the product with a vector would have taken.
    """
    H, b = right.normal_equations(right.jacobian(x, graph), right.information_matrix(graph), right.residual(x, graph))
    step: np.ndarray = np.linalg.inv(H) * -b
    return step


STEP = step.entries
SECOND = second.entries
