"""Judge what a submission reports: iterates and conclusion against the variant on record, and the written answers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from autograder.engine.follow import STAGE
from autograder.engine.normal import array_of, put
from autograder.engine.plan import Plan
from autograder.sandbox.host import Answers, Outputs, Session
from autograder.stages import answers as stage
from autograder.stages import written
from autograder.stages.answers import Finding, Sheet
from autograder.verdicts import CheckVerdict, StageStatus, StageVerdict


def judge_answers(
    plan: Plan, sheet: Sheet, given: Answers, marks: Sequence[StageVerdict], session: Session
) -> StageVerdict:
    """Judge the stage `answers`; iterates that follow from the student's own wrong step earn the follow-through share.

    They do where that step earns points in a stage of its own, as `marks` says. Only then is `session`
    asked for the student's steps.
    """
    points = plan.points[stage.NAME]
    findings = {
        "iterates": stage.iterates_finding(sheet, given.iterates, given.said_of("iterates")),
        "conclusion": stage.conclusion_finding(sheet, given.conclusion, given.said_of("conclusion")),
    }
    followed = False
    if given.iterates is not None and not findings["iterates"].right and _earns(plan, marks):
        steps = own_steps(plan, session, sheet)
        followed = steps is not None and stage.follows(sheet.iterates[0], steps, given.iterates)
    checks = []
    for name, finding in findings.items():
        maximum = round(points * stage.SHARES[name], 6)
        earned = maximum if finding.right else 0.0
        message = finding.message
        if name == "iterates" and followed:
            earned = round(maximum * plan.follow_through, 6)
            message = f"these iterates follow from your own step, which is wrong. {message}"
        checks.append(
            CheckVerdict(name=name, passed=finding.right, points=earned, max_points=maximum, cases=1, message=message)
        )
    score = round(sum(check.points for check in checks), 6)
    wrong = [finding for finding in findings.values() if not finding.right]
    named = next((finding for finding in wrong if finding.slip), None)
    return StageVerdict(
        name=stage.NAME,
        status=_status(list(findings.values()), score),
        score=points if not wrong else score,
        max_score=points,
        slip=None if named is None else named.slip,
        hint="" if named is None else named.hint,
        message=" ".join(check.message for check in checks if check.message),
        checks=tuple(checks),
    )


def _earns(plan: Plan, marks: Sequence[StageVerdict]) -> bool:
    """Whether the step is wrong on the whole, and has points all the same."""
    scores = [each for each in marks if plan.has(each.name) and plan.stage(each.name).function == STAGE]
    right = any(each.name == STAGE and each.status == "passed" for each in scores)
    return not right and any(each.score > 0 for each in scores)


def _status(findings: list[Finding], score: float) -> StageStatus:
    if all(finding.right for finding in findings):
        return "passed"
    if score > 0:
        return "partial"
    return "failed" if any(finding.given for finding in findings) else "missing"


def own_steps(plan: Plan, session: Session, sheet: Sheet) -> Any:
    """Ask the student's step three times along its own way from the start; None where one is no vector."""
    if not plan.has("gauss_newton_step"):
        return None
    step = plan.stage("gauss_newton_step")
    x, found = np.array(sheet.iterates[0]), []
    for _ in range(len(sheet.iterates) - 1):
        outputs = put(session, plan, step, [(x, sheet.graph)])
        dx = array_of(outputs, 0) if isinstance(outputs, Outputs) else None
        if dx is None or dx.shape != x.shape:
            return None
        found.append(dx)
        x = x + dx
    return np.array(found)


def judge_written(points: float, texts: Mapping[str, str], given: Answers) -> StageVerdict:
    """Say whether there is something to mark; the points come from a human reader."""
    absent = written.unanswered(texts)
    everything = len(absent) == len(written.QUESTIONS)
    unusable = {question: given.said_of(f"written_{question}") for question in absent}
    silent = [question for question, said in unusable.items() if not said]
    sentences = [f"question {' and '.join(silent)}: no answer."] if silent else []
    message = " ".join([*sentences, *(f"written_{question}: {said}." for question, said in unusable.items() if said)])
    return StageVerdict(
        name=written.NAME,
        status="missing" if everything else "awaiting_mark",
        score=0.0,
        max_score=points,
        message=f"{message} The rest is marked by hand.".strip() if absent and not everything else message,
    )
