"""Turn what a submission answered into verdicts: a pure function of the plan and the replies."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from autograder.engine import evidence
from autograder.engine.collect import Collected, Reply
from autograder.engine.plan import Plan, Task
from autograder.problems.cases import simplicity
from autograder.sandbox.frames import Outcome
from autograder.sandbox.host import Outputs
from autograder.stages.base import Stage
from autograder.verdicts import CheckVerdict, StageStatus, StageVerdict

# What a stage is called whose checks all failed for this reason.
_STATUS_OF_FAILURE: dict[str, StageStatus] = {
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


def judge(plan: Plan, collected: Collected) -> tuple[StageVerdict, ...]:
    """Judge every stage of one submission."""
    return tuple(_judge_stage(plan, stage, tasks, collected) for stage, tasks in plan.stages)


def _judge_stage(plan: Plan, stage: Stage, tasks: tuple[Task, ...], collected: Collected) -> StageVerdict:
    points = plan.points[stage.name]
    if stage.function not in collected.loaded.functions:
        return _missing(stage, tasks, points)
    judged = [_judge_check(task, collected.replies[task.batch], points) for task in tasks]
    checks = tuple(check for check, _ in judged)
    score = round(sum(check.points for check in checks), 6)
    passed = all(check.passed for check in checks)
    first = next((index for index, check in enumerate(checks) if not check.passed), None)
    status: StageStatus = "passed"
    if first is not None:
        status = "partial" if score > 0 else judged[first][1]
    return StageVerdict(
        name=stage.name,
        status=status,
        score=points if passed else score,
        max_score=points,
        bonus=stage.bonus,
        message="" if first is None else checks[first].message,
        remarks=evidence.remarks(tasks, collected.replies),
        checks=checks,
    )


def _missing(stage: Stage, tasks: tuple[Task, ...], points: float) -> StageVerdict:
    message = f"{stage.function} is not defined in the submission."
    return StageVerdict(
        name=stage.name,
        status="missing",
        score=0.0,
        max_score=points,
        bonus=stage.bonus,
        message=message,
        checks=tuple(
            CheckVerdict(
                name=task.rung.name,
                passed=False,
                points=0.0,
                max_points=_points(task, points),
                cases=len(task.cases),
                message=message,
            )
            for task in tasks
        ),
    )


def _points(task: Task, points: float) -> float:
    return round(points * task.share, 6)


def _judge_check(task: Task, reply: Reply, points: float) -> tuple[CheckVerdict, StageStatus]:
    failure = reply.failure
    maximum = _points(task, points)
    verdict: dict[str, Any] = {"name": task.rung.name, "max_points": maximum, "cases": len(task.cases)}
    if failure is not None or not isinstance(reply.outputs, Outputs):
        assert failure is not None  # a reply without numbers has a reason
        status = _STATUS_OF_FAILURE[failure.reason]
        return CheckVerdict(**verdict, passed=False, points=0.0, message=failure.message), status
    right = judged_cases(task, reply)
    if right.all():
        return CheckVerdict(**verdict, passed=True, points=maximum), "passed"
    index = simplest(task, ~right)
    outcome, message = evidence.why(task, index, reply)
    return (
        CheckVerdict(
            **verdict,
            passed=False,
            points=0.0,
            message=message,
            counterexample=evidence.counterexample(task, index, reply),
        ),
        _STATUS_OF_OUTCOME[outcome],
    )


def judged_cases(task: Task, reply: Reply) -> NDArray[np.bool_]:
    """Say for each case whether it is right: every call returned numbers, and they are judged right."""
    assert isinstance(reply.outputs, Outputs)
    again = reply.again if isinstance(reply.again, Outputs) else None
    right = task.stage.judge(task.prepared, reply.outputs, again)
    if reply.outputs.outcome.any():
        clean = np.logical_and.reduceat(reply.outputs.outcome == Outcome.OK, evidence.first_calls(task))
        right = right & clean
    return right


def simplest(task: Task, chosen: NDArray[np.bool_]) -> int:
    """Return the number of the simplest of the chosen cases."""
    return min(np.flatnonzero(chosen).tolist(), key=lambda index: simplicity(task.cases[index]))
