"""f, J and Omega of a submission side by side, row by row: what they have in common, whatever each stage says alone."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from autograder.diagnosis.equivalence import Convention, Rows, convention, whitened
from autograder.diagnosis.recognise import Given
from autograder.engine.collect import Collected, Reply
from autograder.engine.normal import arrays_of
from autograder.engine.plan import Plan, Task
from autograder.problems.cases import Case
from autograder.sandbox.host import Outputs

INTERCHANGEABLE = ("residual", "jacobian", "information_matrix")  # stages that a common convention keeps whole


class RowsOf:
    """Compares rows of submissions of one run; remembers the expected ones, so that they are worked out once."""

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self._stages = [plan.stage(name) for name in INTERCHANGEABLE if plan.has(name)]
        self._expected: list[Rows] = []

    def convention(self, collected: Collected) -> Convention | None:
        """Find one convention that explains f, J and Omega of every case, where one of them is not as expected."""
        return (
            convention(zip(self._given(collected), self._wanted(), strict=False)) if self._doubtful(collected) else None
        )

    def whitened(self, collected: Collected) -> bool:
        """Whether f and J are divided by the standard deviations and Omega is the identity, in every case."""
        if not self._doubtful(collected):
            return False
        return whitened(zip(self._given(collected), self._wanted(), strict=False))

    def _doubtful(self, collected: Collected) -> bool:
        """Whether all three are asked, and one of them is not as expected."""
        replies = self._replies(collected)
        return len(replies) == len(INTERCHANGEABLE) and not all(
            reply is not None and reply.passed for found in replies for reply in found
        )

    def _replies(self, collected: Collected) -> list[list[Reply | None]]:
        return [[collected.replies.get(task.batch) for task in self.plan.tasks_of(stage)] for stage in self._stages]

    def _given(self, collected: Collected) -> Iterable[Rows | None]:
        """Give f, J and Omega of the student case by case; None once where they are not numbers of the right shape."""
        for task, *parts in zip(self.plan.tasks_of(self._stages[0]), *self._replies(collected), strict=True):
            yield from _own(task, parts)

    def _wanted(self) -> list[Rows]:
        """Return f, J and Omega of every case of the graphs, worked out once."""
        if not self._expected:
            for task in self.plan.tasks_of(self._stages[0]):
                for case in task.cases:
                    found = (stage.expected(*stage.calls(case)[0])[0] for stage in self._stages)
                    self._expected.append(Rows(*found))
        return self._expected


def _own(task: Task, parts: Sequence[Reply | None]) -> list[Rows | None]:
    found = [part.outputs for part in parts if part is not None and isinstance(part.outputs, Outputs)]
    if len(found) < len(parts) or any(each.outcome.any() or not np.isfinite(each.data).all() for each in found):
        return [None]
    rows: list[Rows | None] = []
    for (_, graph), f, J, omega in zip(task.cases, *map(arrays_of, found), strict=True):
        m, n = graph.n_factors, graph.n_poses
        if J.shape != (m, n) or omega.shape != (m, m) or f.shape != (m,):
            return [None]
        rows.append(Rows(f, J, omega))
    return rows


def priors_last(cases: Sequence[Case], given: Given) -> Given | None:
    """Move the first rows of all answers, as many as there are priors, to the end; None where that cannot be done.

    Rows and columns of Omega move together.
    """
    if len(cases) != len(given.shapes) or given.outcome.any():
        return None
    moved = []
    for number, (case, shape) in enumerate(zip(cases, given.shapes, strict=True)):
        array = given.data[given.offsets[number] : given.offsets[number + 1]].reshape(shape)
        graph = case[-1]
        if shape[:1] != (graph.n_factors,):
            return None
        array = np.roll(array, -len(graph.priors), axis=0)
        moved.append(np.roll(array, -len(graph.priors), axis=1) if len(case) == 1 and array.ndim == 2 else array)
    return Given(given.outcome, given.shapes, given.offsets, np.concatenate([array.ravel() for array in moved]))
