"""Turn what a submission answered into marks: a pure function of the plan and the replies.

Every status and every point is final here; what comes later only adds words.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from autograder.diagnosis.equivalence import Convention, Rows, convention
from autograder.engine import follow
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
        """Judge every stage of one submission."""
        accepted = self._convention(collected)
        return tuple(self._stage(stage, tasks, collected, accepted) for stage, tasks in self.plan.stages)

    def _stage(
        self, stage: Stage, tasks: tuple[Task, ...], collected: Collected, accepted: Convention | None
    ) -> StageVerdict:
        points = self.plan.points[stage.name]
        replies = [collected.reply(task) for task in tasks]
        if accepted is not None and stage.name in _INTERCHANGEABLE:
            checks = [_passed(task, points) for task in tasks]
            return _verdict(stage, points, checks, "passed", remarks=(accepted.remark,))
        judged = [_check(task, reply, points) for task, reply in zip(tasks, replies, strict=True)]
        checks = [check for check, _ in judged]
        status: StageStatus = next((reason for check, reason in judged if not check.passed), "passed")
        if stage.name == follow.STAGE and collected.own_systems is not None:
            checks = [
                self._followed(check, task, reply, points, collected.own_systems)
                for check, task, reply in zip(checks, tasks, replies, strict=True)
            ]
        followed = all(check.passed or check.points for check in checks)
        lead = "" if followed or status == "missing" else self._earlier(stage, collected)
        return _verdict(stage, points, checks, status, lead=lead)

    def _earlier(self, stage: Stage, collected: Collected) -> str:
        """Say which earlier functions are wrong, to somebody whose step may be wrong only because of them."""
        if stage.function != follow.STAGE:
            return ""
        wrong = [
            name
            for name in follow.EARLIER
            if any(
                not reply.passed
                for task in self.plan.tasks
                if task.stage.name == name and (reply := collected.replies.get(task.batch)) is not None
            )
        ]
        return f"Mend {' and '.join(wrong)} first, which the step builds on." if wrong else ""

    def _followed(
        self, check: CheckVerdict, task: Task, reply: Reply, points: float, own: dict[str, follow.Systems]
    ) -> CheckVerdict:
        """Pay the follow-through share for a step that solves the student's own equations."""
        if check.passed or not isinstance(reply.outputs, Outputs) or reply.outputs.outcome.any():
            return check
        if not own[task.rung.name].solved_by(arrays_of(reply.outputs)):
            return check
        return _check_verdict(
            task,
            points,
            earned=self.plan.follow_through,
            message=f"dx solves your own H dx = -b: the mistake is in an earlier function. {check.message}",
        )

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
        own = None if f is None or J is None or omega is None else follow.own_calls(task.cases, [J, omega, f])
        return [None] if own is None else own

    def _expected_rows(self, stages: list[Stage]) -> list[Rows]:
        """Return f, J and Omega of every case of the graphs, worked out once."""
        if not self._rows:
            for task in self.plan.tasks_of(stages[0]):
                for case in task.cases:
                    self._rows.append(Rows(*(stage.expected(*stage.calls(case)[0])[0] for stage in stages)))
        return self._rows


def _verdict(
    stage: Stage,
    points: float,
    checks: list[CheckVerdict],
    status: StageStatus,
    remarks: tuple[str, ...] = (),
    lead: str = "",
) -> StageVerdict:
    first = next((check for check in checks if not check.passed), None)
    score = points if first is None else round(sum(check.points for check in checks), 6)
    message = "" if first is None else first.message
    message = " ".join(part for part in (lead, message) if part)
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


def _check_verdict(task: Task, points: float, earned: float = 0.0, message: str = "") -> CheckVerdict:
    maximum = round(points * task.share, 6)
    return CheckVerdict(
        name=task.rung.name,
        passed=False,
        points=round(maximum * earned, 6),
        max_points=maximum,
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
        return _check_verdict(task, points, message=message), _STATUS_OF_FAILURE[reply.failure.reason]
    if reply.passed:
        return _passed(task, points), "passed"
    outcome, message = plainly(task, simplest(task, ~reply.right), reply)
    return _check_verdict(task, points, message=message), _STATUS_OF_OUTCOME[outcome]
