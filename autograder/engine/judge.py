"""Turn what a submission answered into marks: a pure function of the plan and the replies.

Every status and every point is final here; what comes later only adds words.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from msgspec.structs import replace

from autograder.diagnosis.equivalence import Convention, Rows, convention
from autograder.engine.collect import Absent, Collected, Reply
from autograder.engine.evidence import plainly, simplest
from autograder.engine.normal import arrays_of
from autograder.engine.plan import Plan, Task
from autograder.problems.cases import Case
from autograder.sandbox.frames import Outcome
from autograder.sandbox.host import Outputs
from autograder.stages.base import Stage
from autograder.verdicts import CheckVerdict, StageStatus, StageVerdict

# What a stage is called whose first failed check failed for this reason.
_STATUS_OF_FAILURE: dict[str, StageStatus] = {
    "missing": "missing",
    "undefined": "error",
    "timeout": "timeout",
    "budget": "timeout",
    "memory": "memory",
    "died": "error",
    "output": "error",
    "violation": "error",
}
_STATUS_OF_OUTCOME: dict[Outcome, StageStatus] = {
    Outcome.RAISED: "error",
    Outcome.FORBIDDEN: "forbidden",
    Outcome.MEMORY: "memory",
    Outcome.UNFINISHED: "missing",
    Outcome.BAD_VALUE: "failed",
    Outcome.OK: "failed",
}
_INTERCHANGEABLE = ("residual", "jacobian", "information_matrix")  # stages that a common convention keeps whole


class Judge:
    """Judges submissions of one run; remembers the expected rows of the graphs, so that they are worked out once."""

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self._rows: list[Rows] = []

    def judge(self, collected: Collected) -> tuple[StageVerdict, ...]:
        """Judge every stage of one submission, earlier ones first."""
        accepted = self._convention(collected)
        verdicts: dict[str, StageVerdict] = {}
        for stage, tasks in self.plan.stages:
            wrong = [name for name in stage.builds_on if name in verdicts and verdicts[name].status != "passed"]
            verdicts[stage.name] = self._stage(stage, tasks, collected, accepted, wrong)
        return tuple(verdicts.values())

    def _stage(
        self,
        stage: Stage,
        tasks: tuple[Task, ...],
        collected: Collected,
        accepted: Convention | None,
        wrong: Sequence[str],
    ) -> StageVerdict:
        points = self.plan.points[stage.name]
        replies = [collected.reply(task) for task in tasks]
        if accepted is not None and stage.name in _INTERCHANGEABLE:
            checks = [_passed(task, points) for task in tasks]
            return _verdict(stage, points, checks, "passed", remarks=(accepted.remark,))
        judged = [_check(task, reply, points) for task, reply in zip(tasks, replies, strict=True)]
        status: StageStatus = next((reason for check, reason in judged if not check.passed), "passed")
        checks = [check for check, _ in judged]
        said = _redefined(stage, status, collected)
        if not wrong or status == "passed":
            return _verdict(stage, points, checks, status, lead=said)
        apart = [collected.apart.get((stage.name, task.rung.name)) for task in tasks]
        checks = [self._by_itself(check, found) for check, found in zip(checks, apart, strict=True)]
        lead = self._mend(wrong, checks, apart)
        return _verdict(stage, points, checks, status, lead=f"{said} {lead}".strip())

    def _mend(self, wrong: Sequence[str], checks: Sequence[CheckVerdict], apart: Sequence[Reply | None]) -> str:
        """Say what to mend first, and what asking the step by itself has shown."""
        first = f"Mend {' and '.join(wrong)} first, which the step builds on."
        again = "it was asked again, on other graphs and with right functions in the place of yours."
        if any(found is not None and found.failure is None and not found.passed for found in apart):
            return f"{first} The step is wrong by itself, too: {again}"
        if self.plan.follow_through > 0 and all(check.points for check in checks):
            share = self.plan.follow_through
            return f"{first} The step keeps {'its' if share == 1 else f'{100 * share:g} % of its'} points: {again}"
        return first

    def _by_itself(self, check: CheckVerdict, apart: Reply | None) -> CheckVerdict:
        """Pay the follow-through share for a check that is right by itself."""
        if check.passed or apart is None or not apart.passed:
            return check
        earned = round(check.max_points * self.plan.follow_through, 6)
        return replace(check, points=earned, message=f"Right by itself; with your own functions: {check.message}")

    def _convention(self, collected: Collected) -> Convention | None:
        """Find one convention that explains f, J and Omega of every case, where one of them is not as expected."""
        stages = [self.plan.stage(name) for name in _INTERCHANGEABLE if self.plan.has(name)]
        if len(stages) != len(_INTERCHANGEABLE):
            return None
        replies = {
            stage.name: [collected.replies.get(task.batch) for task in self.plan.tasks_of(stage)] for stage in stages
        }
        if all(reply is not None and reply.passed for found in replies.values() for reply in found):
            return None
        given = (
            None if own is None else Rows(own[2], own[0], own[1])
            for position, task in enumerate(self.plan.tasks_of(stages[0]))
            for own in self._own_rows(task, [replies[name][position] for name in _INTERCHANGEABLE])
        )
        return convention(zip(given, self._expected_rows(stages), strict=False))

    def _own_rows(self, task: Task, parts: Sequence[Reply | None]) -> Iterable[Case | None]:
        """Give J, Omega and f of the student case by case; None once where they are not numbers of the right shape."""
        f, J, omega = (
            None if part is None or not isinstance(part.outputs, Outputs) else part.outputs for part in parts
        )
        own = None if f is None or J is None or omega is None else _rows(task.cases, [J, omega, f])
        return [None] if own is None else own

    def _expected_rows(self, stages: list[Stage]) -> list[Rows]:
        """Return f, J and Omega of every case of the graphs, worked out once."""
        if not self._rows:
            for task in self.plan.tasks_of(stages[0]):
                for case in task.cases:
                    self._rows.append(Rows(*(stage.expected(*stage.calls(case)[0])[0] for stage in stages)))
        return self._rows


def _rows(cases: Sequence[Case], outputs: Sequence[Outputs]) -> list[Case] | None:
    """Return (J, Omega, f) of the student for every case; None where one is not numbers of the right shape."""
    if any(each.outcome.any() for each in outputs) or not all(np.isfinite(each.data).all() for each in outputs):
        return None
    rows = []
    for (_, graph), J, omega, f in zip(cases, *map(arrays_of, outputs), strict=True):
        m, n = graph.n_factors, graph.n_poses
        if J.shape != (m, n) or omega.shape != (m, m) or f.shape != (m,):
            return None
        rows.append((J, omega, f))
    return rows


def _redefined(stage: Stage, status: StageStatus, collected: Collected) -> str:
    """Say so where the function that was called is not the one that was meant."""
    fate = collected.loaded.fates.get(stage.function)
    there = stage.function in collected.loaded.functions and status not in {"passed", "missing"}
    return fate.message if fate is not None and there else ""


def _verdict(
    stage: Stage,
    points: float,
    checks: list[CheckVerdict],
    status: StageStatus,
    remarks: tuple[str, ...] = (),
    lead: str = "",
) -> StageVerdict:
    failed = sorted((check for check in checks if not check.passed), key=lambda check: check.points > 0)
    score = round(sum(check.points for check in checks), 6) if failed else points
    message = " ".join(part for part in (lead, failed[0].message) if part) if failed else ""
    return StageVerdict(
        name=stage.name,
        status="partial" if status != "passed" and score > 0 else status,
        score=score,
        max_score=points,
        bonus=stage.bonus,
        message=message,
        remarks=remarks,
        checks=tuple(checks),
    )


def _failed(task: Task, points: float, message: str) -> CheckVerdict:
    return CheckVerdict(
        name=task.rung.name,
        passed=False,
        points=0.0,
        max_points=round(points * task.share, 6),
        cases=len(task.cases),
        message=message,
    )


def _passed(task: Task, points: float) -> CheckVerdict:
    maximum = round(points * task.share, 6)
    return CheckVerdict(name=task.rung.name, passed=True, points=maximum, max_points=maximum, cases=len(task.cases))


def _check(task: Task, reply: Reply, points: float) -> tuple[CheckVerdict, StageStatus]:
    if reply.failure is not None:
        message = reply.failure.message
        if not isinstance(reply.failure, Absent):
            message = f"While {task.stage.function} ran, {message}."
        return _failed(task, points, message), _STATUS_OF_FAILURE[reply.failure.reason]
    if reply.passed:
        return _passed(task, points), "passed"
    outcome, message = plainly(task, simplest(task, ~reply.right), reply)
    return _failed(task, points, message), _STATUS_OF_OUTCOME[outcome]
