"""What the functions before the step answer for given graphs, as numbers: f = J x + c, and all that follows from it.

Where a step is to be judged by itself, these stand in the place of the student's own functions. They are tables:
`normal_equations` too answers only for the J and Omega of these graphs, with H as a number and b as a matrix times
the f that it is given. So nothing of them is of use for another graph, or as another stage's function.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from assignment.posegraph import PoseGraph
from autograder.stages.base import Array
from reference_solution import slam1d

FUNCTIONS = ("residual", "jacobian", "information_matrix", "normal_equations")

Part = tuple[Array, Array | None]
"""An array of an answer: a constant, and the factor of the vector that is given, where there is one."""


@dataclass(frozen=True)
class Answers:
    """What one function answers.

    Parameters
    ----------
    function : str
        Its name.
    places : tuple of int
        Places of the arguments by which the answer is looked up.
    vector : int
        Place of the vector that factors multiply; -1 where there is none.
    rows : list
        For each combination of those arguments the parts of the answer.
    """

    function: str
    places: tuple[int, ...]
    vector: int
    rows: list[tuple[tuple[Any, ...], tuple[Part, ...]]]


def answers(graphs: Sequence[PoseGraph]) -> list[Answers]:
    """Work out what the four functions answer for these graphs."""
    f, J_of = Answers("residual", (1,), 0, []), Answers("jacobian", (1,), -1, [])
    omega_of = Answers("information_matrix", (0,), -1, [])
    equations: dict[tuple[bytes, bytes], tuple[tuple[Any, ...], tuple[Part, ...]]] = {}
    for graph in graphs:
        origin = np.zeros(graph.n_poses)
        J, omega = slam1d.jacobian(origin, graph), slam1d.information_matrix(graph)
        f.rows.append(((graph,), ((slam1d.residual(origin, graph), J),)))
        J_of.rows.append(((graph,), ((J, None),)))
        omega_of.rows.append(((graph,), ((omega, None),)))
        weighted = J.T @ omega
        parts: tuple[Part, ...] = ((weighted @ J, None), (origin, weighted))
        equations.setdefault((J.tobytes(), omega.tobytes()), ((J, omega), parts))
    return [f, J_of, omega_of, Answers("normal_equations", (0, 1), 2, list(equations.values()))]
