"""Slips of `residual`: what comes instead of f.

A loop is what a student takes for one: an edge between poses that are not neighbours.
"""
# ruff: noqa: ARG001, D401 - a slip has the stage's signature, used or not, and its docstring states what is wrong

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from autograder.stages.slips import narrow
from autograder.stages.slips.catalogue import Catalogue
from autograder.stages.slips.patterns import typed_in
from autograder.stages.slips.residual_digits import LOST_DIGITS
from reference_solution import slam1d as right

if TYPE_CHECKING:
    from assignment.posegraph import PoseGraph

slip = Catalogue()


@slip("R1", minimum_poses=3)
def loop_residual_without_measurement(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The loop's row leaves its measurement out.

    A loop closure is a between factor like any other; returning to a place does not mean that 0 was measured.
    """
    i, j = graph.edges.T
    used = np.where(np.abs(j - i) > 1, 0.0, graph.measurements)
    return np.concatenate([x[i] + used - x[j], x[graph.priors] - graph.prior_means])


@slip("R2", minimum_poses=3)
def loop_residual_spans_whole_chain(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The loop's row always joins the first pose and the last.

    A loop may close between any two poses, in either direction; which two is written in the graph.
    """
    i, j = graph.edges.T
    loop = np.abs(j - i) > 1
    i, j = np.where(loop, 0, i), np.where(loop, graph.n_poses - 1, j)
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


@slip()  # a near relative of R2: here the place in the list, not the poses, makes a loop
def last_edge_residual_spans_whole_chain(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The last edge of the list is taken to join the first pose and the last.

    Edges come in any order and there may be no loop or several; only the pair of poses says what an edge joins.
    """
    f = right.residual(x, graph)
    f[: len(graph.edges)][-1:] = x[0] + graph.measurements[-1:] - x[-1]
    return f


@slip("R3", minimum_poses=3)
def loop_residual_takes_last_measurement(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The loop's row takes the measurement of the last edge in the list.

    Edges come in any order, and there may be two loops; each row has a measurement of its own.
    """
    i, j = graph.edges.T
    used = np.where(np.abs(j - i) > 1, graph.measurements[-1:], graph.measurements)
    return np.concatenate([x[i] + used - x[j], x[graph.priors] - graph.prior_means])


@slip("R4")
def prior_residual_always_zero(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The prior's row is 0 at every state.

    It is 0 only while the pose stands where the prior believes it; what should it say once the pose has moved?
    """
    f = right.residual(x, graph)
    f[len(graph.edges) :] = 0.0
    return f


@slip("R5")
def prior_residual_without_mean(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The prior's row leaves the mean out.

    A prior says where the pose is believed to stand, and that need not be the origin.
    """
    return np.concatenate([right.residual(x, graph)[: len(graph.edges)], x[graph.priors]])


@slip("R6")
def prior_residual_always_on_pose_0(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The prior's row always looks at pose 0.

    Any pose may carry a prior, and several may; which ones is written in the graph.
    """
    return np.concatenate([right.residual(x, graph)[: len(graph.edges)], x[0] - graph.prior_means])


@slip("R8")
def prior_residual_opposite_sign(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The prior's row has the opposite sign.

    The handout fixes what is subtracted from what; the sign must also suit the row of J.
    """
    return np.concatenate([right.residual(x, graph)[: len(graph.edges)], graph.prior_means - x[graph.priors]])


@slip("R9")
def between_residual_opposite_sign(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The rows of all between factors have the opposite sign.

    The row of an edge is where the edge puts pose j, minus where the state puts it; which does the measurement give?
    """
    f = right.residual(x, graph)
    f[: len(graph.edges)] *= -1.0
    return f


@slip()
def residual_opposite_sign(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """Every row has the opposite sign, priors included.

    The handout fixes what is subtracted from what; f and J must agree on it.
    """
    return -right.residual(x, graph)


@slip()
def measurement_subtracted(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The measurement enters the between rows with the wrong sign.

    Walk from pose i by the measured displacement: on which side of x_i do you arrive?
    """
    i, j = graph.edges.T
    return np.concatenate([x[i] - graph.measurements - x[j], x[graph.priors] - graph.prior_means])


@slip()
def edge_ends_exchanged(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The two ends of every edge are exchanged.

    A row (i, j) was measured from pose i to pose j; the walk begins at the first of them.
    """
    j, i = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


@slip()
def backward_residual_read_forward(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """An edge from a later pose to an earlier one is read as if it went forward.

    An edge has a direction: its measurement turns sign when the same walk is told from the other end.
    """
    i, j = np.sort(graph.edges, axis=1).T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


@slip()
def residual_rows_read_as_chain(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The first rows join pose r and pose r + 1, whatever their edges say.

    The number of a row is its place in a list; the poses that it joins are written in the row itself.
    """
    f = right.residual(x, graph)
    for row in range(min(graph.n_poses - 1, len(graph.edges))):
        f[row] = x[row] + graph.measurements[row] - x[row + 1]
    return f


@slip("R12")
def residual_without_sign(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The residual is an absolute value.

    Least squares squares the residual later; before that, its sign says in which direction to correct.
    """
    f: np.ndarray = np.abs(right.residual(x, graph))
    return f


@slip()
def residual_squared(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The residual is squared already.

    The square belongs to the cost, which is a single number; f is what will be squared.
    """
    return right.residual(x, graph) ** 2


@slip()
def residual_whitened(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The residual is divided by the standard deviations.

    That is the whitened residual, a good thing elsewhere; here f is in metres and the weights live in Omega alone.
    """
    f: np.ndarray = right.residual(x, graph) / np.sqrt(np.concatenate([graph.edge_variances, graph.prior_variances]))
    return f


@slip("R17")
def residual_always_at_the_start(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The residual is that of dead reckoning, whatever state is given.

    f is a function of the state: move the robot, and every row that touches it must change.
    """
    return right.residual(graph.dead_reckoning(), graph)


@slip("R18")
def residual_of_worked_example(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The residual is the printed one of the worked example.

    Those six numbers hold for one graph at one state; calculate them from what you are given.
    """
    return np.array([0.0, 0.0, 0.0, 0.0, -0.5, 0.0])


@slip(pattern=typed_in)
def residual_typed_in_for_worked_example(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The rows are typed in for the edges of the worked example.

    Those five edges and that one prior belong to one graph; go over the edges and priors of the graph that is given.
    """
    u = graph.measurements
    rows = [x[r] + u[r] - x[r + 1] for r in range(4)]
    return np.array([*rows, x[0] + u[4] - x[4], x[0]])


@slip()
def prior_residual_is_pose_0(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The row of every prior is x_0 itself: always pose 0, and without the mean.

    A prior says of some pose where it is believed to stand; which pose, and where, is written in the graph.
    """
    return np.concatenate([right.residual(x, graph)[: len(graph.edges)], np.full(len(graph.priors), x[0])])


@slip("R21", minimum_poses=3)
def residual_rows_odometry_first(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The rows of the odometry come before those of the loops, whatever their order in the graph.

    Row r of f, J and Omega must speak of the same factor; the common order is that of the graph.
    """
    f = right.residual(x, graph)
    order = np.argsort(np.abs(np.diff(graph.edges, axis=1)).ravel() > 1, kind="stable")
    return np.concatenate([f[order], f[len(order) :]])


@slip()
def residual_rows_priors_first(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The rows of the priors come first.

    Row r of f, J and Omega must speak of the same factor; the handout puts the edges before the priors.
    """
    return np.roll(right.residual(x, graph), len(graph.priors))


@slip()
def prior_residual_missing(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The rows of the priors are missing.

    Count the factors: every prior is one too, and without it nothing says where the whole chain stands.
    """
    return right.residual(x, graph)[: len(graph.edges)]


@slip()
def second_prior_residual_takes_first_mean(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """Every prior is given the mean of the first one.

    There may be several priors, and each brings its own belief.
    """
    return np.concatenate([right.residual(x, graph)[: len(graph.edges)], x[graph.priors] - graph.prior_means[0]])


@slip("R22")
def residual_by_dead_reckoning(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The pose where an edge begins is worked out by adding up the measurements from pose 0.

    Every pose is an unknown with a value of its own in x; the motion model predicts one step, not the whole walk.
    """
    i, j = graph.edges.T
    walked = graph.dead_reckoning()
    begin = x[0] + walked - walked[0]
    return np.concatenate([begin[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


@slip("R23")
def residual_of_six_rows(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
    """The residual has six rows, as in the worked example.

    How many factors a graph has is a property of the graph; ask it.
    """
    return np.pad(right.residual(x, graph), (0, 6))[:6]


SLIPS = (*slip.entries, *LOST_DIGITS, *narrow.RESIDUAL)
