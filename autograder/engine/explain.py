"""Explain a wrong stage: ask the submission more, for true sentences about it and a small case that shows it.

The submission itself is asked all cases of the gallery, in a child that has answered nothing else,
and is shown the simplest that it gets wrong. Nobody else's answers count: what a page shows
depends on one submission alone. Where the whole gallery is right, the case of the exam stands.
The marks are final before; each step is an attempt, and one that fails leaves the words that were there.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np
from msgspec.structs import replace

from autograder.attempts import Attempts
from autograder.diagnosis.facts import Answered, facts
from autograder.diagnosis.probes import Values, derivative_probe, probes, remembers
from autograder.engine.collect import Reply, ask
from autograder.engine.describe import swapped
from autograder.engine.evidence import plainly, simplest
from autograder.engine.follow import EARLIER, STAGE
from autograder.engine.judge import STATUS_OF_OUTCOME
from autograder.engine.normal import array_of, put
from autograder.engine.plan import Plan, Task
from autograder.engine.showing import Example, counterexample, why
from autograder.problems.cases import Case
from autograder.sandbox.frames import Outcome
from autograder.sandbox.host import Outputs, Session
from autograder.stages.base import Stage
from autograder.stages.same import finite
from autograder.verdicts import CheckVerdict, StageStatus, StageVerdict


def wants_explanation(verdict: StageVerdict) -> bool:
    """Whether a verdict is of wrong answers that another look can say more about."""
    if verdict.status not in {"failed", "partial", "error"} or not verdict.group:
        return False
    open_checks = [check for check in verdict.checks if not check.passed]
    return not all(check.points for check in open_checks)  # follow-through says where the mistake is


def explain(
    session: Session, plan: Plan, verdicts: Sequence[StageVerdict], replies: Mapping[int, Reply], attempt: Attempts
) -> list[StageVerdict]:
    """Explain all wrong stages of a submission.

    A step of no known mistake is not explained where an earlier function is wrong: its message says
    already what to mend first, and shows a case of the exam.

    Parameters
    ----------
    session : Session
        Its child is replaced by a fresh one, with time of its own: what the exam took does not count.
    plan : Plan
        The exam.
    verdicts : sequence of StageVerdict
        What was judged.
    replies : mapping of int to Reply
        What the submission answered to the exam, by the number of the batch.
    attempt : Attempts
        Tries each step, and keeps which failed.

    Returns
    -------
    list of StageVerdict
        The verdicts, in their order; those that want none are as they were.
    """
    earlier_is_wrong = any(each.name in EARLIER and each.status != "passed" for each in verdicts)
    wanted = {
        each.name
        for each in verdicts
        if wants_explanation(each)
        and not (earlier_is_wrong and each.slip is None and plan.stage(each.name).function == STAGE)
    }
    if not wanted:
        return list(verdicts)
    session.afresh()
    residual_is_wrong = any(each.name == "residual" and each.status != "passed" for each in verdicts)

    def probed(stage: Stage) -> list[str]:
        if stage.name not in {*EARLIER, STAGE} or not all(
            _usable(task, replies.get(task.batch)) for task in plan.tasks_of(stage)
        ):
            return []
        return _probed(session, plan, stage, residual_is_wrong=residual_is_wrong)

    return [
        _explained(session, plan, each, replies, attempt, probed) if each.name in wanted else each for each in verdicts
    ]


def _explained(
    session: Session,
    plan: Plan,
    verdict: StageVerdict,
    replies: Mapping[int, Reply],
    attempt: Attempts,
    probed: Callable[[Stage], list[str]],
) -> StageVerdict:
    number, check = _first_open(verdict)
    stage = plan.stage(verdict.name).facet(check.name)
    found: list[str] = []
    if verdict.slip is None:
        found += attempt(f"reading facts off {stage.name}", _facts, plan, stage, replies) or []
        found += attempt(f"probing {stage.name}", probed, stage) or []
    task = next(each for each in plan.tasks_of(plan.stage(verdict.name)) if each.rung.name == check.name)
    reply = replies.get(task.batch)
    shown = attempt(f"asking {stage.name} small cases", _shown, session, plan, stage, _kind(task, reply))
    message, example = shown or (check.message, check.counterexample)
    checks = list(verdict.checks)
    checks[number] = replace(check, message=message, counterexample=example)
    words = " ".join(part for part in (*found, message) if part)
    return replace(verdict, checks=tuple(checks), message=swapped(verdict.message, check.message, words))


def _first_open(verdict: StageVerdict) -> tuple[int, CheckVerdict]:
    """Return the first check that earned nothing, with its number."""
    return next((number, check) for number, check in enumerate(verdict.checks) if not check.passed and not check.points)


def _kind(task: Task, reply: Reply | None) -> StageStatus | None:
    """Say of which kind the first wrong answer of a check is: wrong values, an exception; None where none came."""
    if reply is None or reply.failure is not None or reply.right.all():
        return None
    return STATUS_OF_OUTCOME[plainly(task, simplest(task, ~reply.right), reply)[0]]


def _shown(session: Session, plan: Plan, stage: Stage, kind: StageStatus | None) -> tuple[str, Example | None] | None:
    """Ask the gallery; return what is wrong with the simplest case that is, in words and as plain data.

    The case goes wrong as that of the exam did, so that status and words agree: an exception is shown for an exception.
    """
    if kind is None:
        return None
    task = plan.gallery_of(stage)
    reply = ask(session, plan, task)
    if reply.failure is not None:
        return None
    wrong = (int(index) for index in np.flatnonzero(~reply.right))
    index = next((each for each in wrong if STATUS_OF_OUTCOME[plainly(task, each, reply)[0]] == kind), None)
    return None if index is None else (why(task, index, reply), counterexample(task, index, reply))


def _facts(plan: Plan, stage: Stage, replies: Mapping[int, Reply]) -> list[str]:
    """Read off the answers to the exam what is true of all of them."""
    answers: list[Answered] = []
    for task in plan.tasks_of(plan.stage(stage.name)):
        reply = replies.get(task.batch)
        if reply is None or not isinstance(reply.outputs, Outputs) or reply.failure is not None:
            return []
        for index, case in enumerate(task.cases):
            answers.append(Answered(case, bool(reply.right[index]), _got(task, index, reply.outputs)))
    return facts(stage, answers)


def _probed(session: Session, plan: Plan, stage: Stage, *, residual_is_wrong: bool) -> list[str]:
    """Ask a few more questions; of a function that remembers, or throws dice, nothing else is told."""
    memory = remembers(stage.function)
    session.fresh()
    first = _values(session, plan, stage.function, memory.rounds[0])
    session.fresh()
    kept = memory.read(first, _values(session, plan, stage.function, memory.rounds[1]))
    if kept:
        return [kept]
    found = [probe.read(_values(session, plan, probe.function, probe.rounds[0])) for probe in probes(stage.function)]
    if stage.name == "jacobian" and plan.has("residual"):
        of_jacobian, of_residual, read = derivative_probe(
            lambda *call: stage.expected(*call)[0], residual_is_wrong=residual_is_wrong
        )
        answers = [_values(session, plan, probe.function, probe.rounds[0]) for probe in (of_jacobian, of_residual)]
        found.append(read(*answers))
    return [sentence for sentence in found if sentence]


def _usable(task: Task, reply: Reply | None) -> bool:
    """Whether every call of a check returned finite numbers in the right shape."""
    outputs = None if reply is None else reply.outputs
    return (
        isinstance(outputs, Outputs)
        and not outputs.outcome.any()
        and outputs.shapes == task.stage.layout(task.prepared).shapes
        and finite(outputs.data)
    )


def _values(session: Session, plan: Plan, function: str, calls: Sequence[Case]) -> Values:
    stage = next(stage for stage, _ in plan.stages if stage.function == function)
    outputs = put(session, plan, stage, list(calls))
    if not isinstance(outputs, Outputs):
        return [None] * (len(calls) * stage.parts)
    return [
        array_of(outputs, place) if outputs.outcome[place // stage.parts] == Outcome.OK else None
        for place in range(len(calls) * stage.parts)
    ]


def _got(task: Task, index: int, outputs: Outputs) -> tuple[np.ndarray, ...] | None:
    """Return the arrays of the first call of a case, where they have the expected shapes."""
    first = int(task.first_calls[index])
    if outputs.outcome[first] != Outcome.OK:
        return None
    parts = task.stage.parts
    wanted = task.stage.layout(task.prepared).shapes
    numbers = range(first * parts, (first + 1) * parts)
    found = [array_of(outputs, number) for number in numbers if outputs.shapes[number] == wanted[number]]
    return tuple(each for each in found if each is not None) if len(found) == parts else None
