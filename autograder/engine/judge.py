"""Turn what a submission answered into marks: a pure function of the plan and the replies.

Every status and every point is final here; what comes later only adds words.
"""

from __future__ import annotations

from collections.abc import Sequence

from msgspec.structs import replace

from autograder.diagnosis.equivalence import Convention
from autograder.engine.collect import Absent, Collected, Reply
from autograder.engine.evidence import plainly, simplest
from autograder.engine.plan import Plan, Task
from autograder.engine.rows import INTERCHANGEABLE, RowsOf
from autograder.sandbox.frames import Outcome
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
STATUS_OF_OUTCOME: dict[Outcome, StageStatus] = {
    Outcome.RAISED: "error",
    Outcome.FORBIDDEN: "forbidden",
    Outcome.MEMORY: "memory",
    Outcome.UNFINISHED: "missing",
    Outcome.BAD_VALUE: "failed",
    Outcome.OK: "failed",
}


class Judge:
    """Judges submissions of one run."""

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self._rows = RowsOf(plan)

    def judge(self, collected: Collected) -> tuple[StageVerdict, ...]:
        """Judge every stage of one submission, earlier ones first."""
        accepted = self._rows.convention(collected)
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
        if accepted is not None and stage.name in INTERCHANGEABLE:
            checks = [_passed(task, points) for task in tasks]
            return _verdict(stage, points, checks, "passed", remarks=(accepted.remark,))
        judged = [_check(task, reply, points) for task, reply in zip(tasks, replies, strict=True)]
        status: StageStatus = next((reason for check, reason in judged if not check.passed), "passed")
        checks = [check for check, _ in judged]
        said = _redefined(stage, status, collected)
        if not wrong or status in {"passed", "missing"}:
            return _verdict(stage, points, checks, status, lead=said)
        apart = [collected.apart.get((stage.name, task.rung.name)) for task in tasks]
        checks = [self._by_itself(check, found) for check, found in zip(checks, apart, strict=True)]
        lead = self._mend(wrong, checks, apart)
        return _verdict(stage, points, checks, status, lead=f"{said} {lead}".strip())

    def _mend(self, wrong: Sequence[str], checks: Sequence[CheckVerdict], apart: Sequence[Reply | None]) -> str:
        """Say what to mend first, and what asking the step by itself has shown."""
        names = " and ".join(part for part in (", ".join(wrong[:-1]), wrong[-1]) if part)
        first = f"Mend {names} first, which the step builds on."
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
    return _failed(task, points, message), STATUS_OF_OUTCOME[outcome]
