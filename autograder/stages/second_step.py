"""Stage `second_step`: what must be true of any step of a linear problem, with no reference at all."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assignment.posegraph import PoseGraph
from autograder.problems.cases import Case
from autograder.problems.graphs import agreeing, information, loop_edges, nudged
from autograder.problems.ladders import LOOPS
from autograder.stages.base import Answers, Array, Batch, Shape, Stage, aligned
from autograder.stages.earlier import FUNCTIONS
from autograder.stages.wording import number, vector
from reference_solution import slam1d

ROUNDING = 1e-13  # of the numbers of a case: a point that moves by less has not moved


@dataclass(frozen=True)
class Loops:
    """All calls of a batch of loops, flat.

    Call 0 and 1 of a loop start from its two states, the last asks for the graph in which all agrees
    with the second state, and the others have one measurement changed; all of them start from the
    first state. `first` points from every entry to the same pose in call 0 of its loop; `agreed`
    holds, for the entries of the last call, where the step must lead. `loop` tells for every call
    its loop, and the three masks which call it is.
    """

    steps: Batch
    states: Array
    first: NDArray[np.int64]
    agreed: Array
    loop: NDArray[np.int64]
    is_second_start: NDArray[np.bool_]
    is_nudged: NDArray[np.bool_]
    is_agreed: NDArray[np.bool_]
    loop_starts: NDArray[np.int64]
    tolerance: Array
    rounding: Array
    again: Batch
    graphs: tuple[PoseGraph, ...]


class SecondStep(Stage):
    """Asks four things of the student's own step on every loop.

    The step from x + dx(x) is zero; x + dx(x) is the same point from both starts; that point moves
    when any measurement on the loop is changed by 1 m; and where all measurements and priors agree
    with one state, it is that state. The first two hold because the problem is linear. The third
    stops a step that does not look at all measurements, the fourth one that only looks as if it
    did, such as their sum minus x. All four hold whatever the weights.
    """

    name = "second_step"
    function = "gauss_newton_step"
    title = "Second step"
    position = 6
    points = 10.0
    ladder = LOOPS
    builds_on = FUNCTIONS
    shares = {"worked_example": 0.2, "single_loops": 0.4, "loops_in_graphs": 0.4}

    def calls(self, case: Case) -> list[Case]:
        """Return the calls from both states, one for every measurement on the loop, and one where all agrees."""
        (one, two), graph = case
        changed = [(one, each) for each in _changed(graph)]
        return [(one, graph), (two, graph), *changed, (one, agreeing(graph, two))]

    def expected(self, x: Array, graph: PoseGraph) -> tuple[Array, ...]:
        """Return dx by the reference; it sizes the replies and plays no part in the verdict."""
        return (slam1d.gauss_newton_step(x, graph),)

    def shapes(self, x: Array, graph: PoseGraph) -> list[Shape]:
        """Return (n,)."""
        return [(graph.n_poses,)]

    def prepare(self, cases: Sequence[Case]) -> Loops:
        """Lay out all calls of all loops."""
        calls = [self.calls(case) for case in cases]
        counts = np.array([len(group) for group in calls])
        loop = np.repeat(np.arange(len(cases)), counts)
        loop_starts = np.cumsum(counts) - counts
        position = np.arange(len(loop)) - loop_starts[loop]
        last = position == counts[loop] - 1
        steps = _batch([x for group in calls for x, _ in group])
        sizes = steps.ends - steps.starts
        first = np.concatenate(
            [np.arange(size) + steps.starts[loop_starts[c]] for size, c in zip(sizes.tolist(), loop, strict=True)]
        )
        return Loops(
            steps=steps,
            states=np.concatenate([x for group in calls for x, _ in group]),
            first=first,
            agreed=np.concatenate(
                [np.tile(case[0][1], count) for case, count in zip(cases, counts.tolist(), strict=True)]
            ),
            loop=loop,
            is_second_start=position == 1,
            is_nudged=(position > 1) & ~last,
            is_agreed=last,
            loop_starts=loop_starts,
            tolerance=np.array([tolerance(*case) for case in cases]),
            rounding=np.array([ROUNDING * _size(*case) for case in cases]),
            again=_batch([case[0][0] for case in cases]),
            graphs=tuple(case[1] for case in cases),
        )

    def layout(self, prepared: Loops) -> Batch:
        """Return the shapes of the steps of the first round."""
        return prepared.steps

    def follow_up(self, prepared: Loops, answers: Answers) -> list[Case] | None:
        """Return the second round: a call from x + dx(x) for every loop.

        The sum is made here, not in the student's process. A step that came back unusable is
        asked about at x itself: that loop is lost already.
        """
        dx, _ = aligned(prepared.steps, answers)
        points = prepared.states + np.where(np.isfinite(dx), dx, 0.0)
        starts = prepared.steps.starts[prepared.loop_starts].tolist()
        ends = prepared.steps.ends[prepared.loop_starts].tolist()
        return [(points[a:b], graph) for a, b, graph in zip(starts, ends, prepared.graphs, strict=True)]

    def judge(self, prepared: Loops, answers: Answers, again: Answers | None = None) -> NDArray[np.bool_]:
        """Hold every loop to the four properties."""
        return np.asarray(self.properties(prepared, answers, again).all(axis=0))

    def properties(self, prepared: Loops, answers: Answers, again: Answers | None) -> NDArray[np.bool_]:
        """Say for each property (row: zero again, same point, moves, agrees) and loop whether it holds."""
        n = len(prepared.graphs)
        dx, usable = aligned(prepared.steps, answers)
        point = prepared.states + dx
        with np.errstate(invalid="ignore", over="ignore"):
            moved = np.maximum.reduceat(np.abs(point - point[prepared.first]), prepared.steps.starts)
            missed = np.maximum.reduceat(np.abs(point - prepared.agreed), prepared.steps.starts)
        allowed = prepared.tolerance[prepared.loop]
        same = usable & (moved <= allowed)
        moves = usable & (moved > prepared.rounding[prepared.loop])
        agrees = usable & (missed <= allowed)
        hold = np.zeros((4, n), dtype=np.bool_)
        if again is not None:
            second, second_usable = aligned(prepared.again, again)
            with np.errstate(invalid="ignore"):
                size = np.maximum.reduceat(np.abs(second), prepared.again.starts)
            hold[0] = second_usable & (size <= prepared.tolerance) & usable[prepared.loop_starts]
        hold[1] = np.logical_and.reduceat(same | ~prepared.is_second_start, prepared.loop_starts)
        hold[2] = np.logical_and.reduceat(moves | ~prepared.is_nudged, prepared.loop_starts)
        hold[3] = np.logical_and.reduceat(agrees | ~prepared.is_agreed, prepared.loop_starts)
        return hold

    def explain(self, case: Case, got: tuple[Array, ...]) -> str:
        """Say which property broke; `got` holds the first-round steps, then the second step."""
        (one, two), graph = case
        allowed = tolerance(*case)
        point = one + got[0].ravel()
        if len(got) > len(self.calls(case)) and not np.abs(got[-1]).max() <= allowed:
            return f"after one step from {vector(one)} to {vector(point)}, the second step is {vector(got[-1])}, not 0."
        other = two + got[1].ravel()
        if not np.abs(other - point).max() <= allowed:
            return (
                f"x + dx(x) depends on the start: {vector(point)} from {vector(one)}, "
                f"{vector(other)} from {vector(two)}; one minimum was expected."
            )
        for e, changed, dx in zip(loop_edges(graph), _changed(graph), got[2:], strict=False):
            if not np.abs(one + dx.ravel() - point).max() > ROUNDING * _size(*case):
                i, j = graph.edges[e].tolist()
                return (
                    f"the point x + dx(x) = {vector(point)} does not move when the measurement of edge {i} -> {j}, "
                    f"which lies on a loop, changes from {number(graph.measurements[e])} to "
                    f"{number(changed.measurements[e])} m."
                )
        last = one + got[len(self.calls(case)) - 1].ravel()
        return (
            f"where all measurements and priors agree with one state, {vector(two)}, the point x + dx(x) is "
            f"{vector(last)}: it must be that state, whatever the weights."
        )


@lru_cache(maxsize=4096)  # the calls of a case are asked for several times
def _changed(graph: PoseGraph) -> tuple[PoseGraph, ...]:
    """Return a graph for every measurement on a loop, in which that one is changed by 1 m."""
    return tuple(nudged(graph, e) for e in loop_edges(graph))


def tolerance(states: Array, graph: PoseGraph) -> float:
    """Return how far two points may differ and still count as one [m].

    An error of relative size e in J moves the minimum by about sqrt(cond(H)) e |dx|, because H is
    a square; e = 1e-7 leaves room for central differences (1e-8) and for every solver. A guard of
    1e-9, or of 1e-9 of the largest entry, on the diagonal of H costs nothing: it leaves |dx| times
    itself over the smallest eigenvalue.
    """
    H = information(graph)
    eigenvalues = np.linalg.eigvalsh(H)
    guard = 1.1e-9 * (1.0 + H.max())
    factor = 1e-7 * np.sqrt(eigenvalues[-1] / eigenvalues[0]) + guard / eigenvalues[0]
    return float(factor * _size(states, graph))


def _size(states: Array, graph: PoseGraph) -> float:
    """Return how large the numbers of a loop are [m]."""
    return float(1.0 + np.abs(states).max() + np.abs(graph.measurements).max(initial=0.0))


def _batch(states: list[Array]) -> Batch:
    ends = np.cumsum([x.size for x in states])
    return Batch(
        shapes=[x.shape for x in states],
        starts=np.concatenate([[0], ends[:-1]]).astype(np.int64),
        ends=ends.astype(np.int64),
        data=np.zeros(int(ends[-1])),
        tolerance=np.zeros(int(ends[-1])),
        parts=1,
    )


STAGE = SecondStep()
