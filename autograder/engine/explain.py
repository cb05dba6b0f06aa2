"""Explain a wrong stage: true sentences about it, and a small case that shows it.

A known mistake is shown by the smallest case that its own code gets wrong, found once. Any other is
shown by the simplest small case that the submission itself gets wrong; only where all of these are
right is one searched for and reduced, once for each behaviour group, by the member with the smallest
digest of the source. Every member confirms what it is shown by a call of its own.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from msgspec.structs import replace

from autograder.diagnosis.facts import Answered, facts
from autograder.diagnosis.probes import Probe, Values, derivative_probe, probes
from autograder.diagnosis.recognise import trusted_call
from autograder.diagnosis.witness import small_cases, smallest_witness
from autograder.engine import evidence
from autograder.engine.collect import Reply, judged
from autograder.engine.follow import array_of
from autograder.engine.plan import Plan, Task
from autograder.problems.cases import Case
from autograder.problems.ladders import Rung
from autograder.sandbox.frames import Outcome
from autograder.sandbox.host import Outputs, Session
from autograder.stages.base import Slip, Stage, fits
from autograder.stages.catalogue import slips
from autograder.verdicts import StageVerdict


@dataclass(frozen=True)
class Explanation:
    """What a group shares: facts, and a witness where a small one exists."""

    facts: tuple[str, ...] = ()
    witness: Case | None = None


def single(stage: Stage, case: Case) -> Task:
    """Make a check of one case, outside of the plan."""
    return Task(stage, Rung("witness", "the smallest case that shows it", 0.0, (case,)), (case,), -1)


def wants_explanation(verdict: StageVerdict) -> bool:
    """Whether a verdict is of wrong answers that another look can say more about."""
    if verdict.status not in {"failed", "partial", "error"} or not verdict.group:
        return False
    open_checks = [check for check in verdict.checks if not check.passed]
    return not all(check.points for check in open_checks)  # follow-through says where the mistake is


class Explainer:
    """Explains wrong stages of one run; remembers the witnesses of known mistakes."""

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self._of_slip: dict[str, Case | None] = {}

    def known(self, stage: Stage, identifier: str) -> Explanation:
        """Explain a known mistake by its own code."""
        if identifier not in self._of_slip:
            slip = next(slip for slip in slips(stage.name) if slip.identifier == identifier)
            self._of_slip[identifier] = smallest_witness(
                stage.ladder.name, lambda case: _slip_is_wrong(stage, slip, case)
            )
        return Explanation(witness=self._of_slip[identifier])

    def explain(
        self, session: Session, verdict: StageVerdict, given: Explanation | None
    ) -> tuple[StageVerdict, Explanation]:
        """Put an explanation into a verdict; return both.

        A known mistake is shown by the witness of its own code. Any other is described by asking
        this submission itself, and shown by the first of the small cases that it gets wrong: nobody
        else's answers count, for another member of the group may lie when it is asked again. Only
        where all small cases are right is a witness searched for, once for the group.
        """
        first = next(check.name for check in verdict.checks if not check.passed and not check.points)
        stage = self.plan.stage(verdict.name).facet(first)
        if verdict.slip is not None:
            known = self.known(stage, verdict.slip) if given is None else given
            confirmed = self._confirmed(session, stage, verdict, known)
            return (verdict, known) if confirmed is None else (confirmed, known)
        found = (*self._facts(session, stage), *self._probed(session, stage))
        witness = self._first_wrong(session, stage)
        if witness is None and given is not None:
            shared = Explanation(found, given.witness)
            confirmed = self._confirmed(session, stage, verdict, shared)
            if confirmed is not None:
                return confirmed, shared
        own = Explanation(found, witness or self._searched(session, stage))
        return self._confirmed(session, stage, verdict, own) or verdict, own

    def _first_wrong(self, session: Session, stage: Stage) -> Case | None:
        """Ask all small cases at once; return the simplest that is wrong."""
        cases = small_cases(stage.ladder.name)
        task = Task(stage, Rung("witness", "small cases", 0.0, cases), cases, -1)
        calls = [call for case in cases for call in stage.calls(case)]
        reply = judged(session, self.plan, task, session.call(self.plan.batch(stage, calls)))
        if reply.failure is not None or reply.right.all():
            return None
        return cases[int(np.argmin(reply.right))]

    def _searched(self, session: Session, stage: Stage) -> Case | None:
        """Search for a case that this submission gets wrong, and have it reduced."""
        return smallest_witness(stage.ladder.name, lambda case: not self._ask(session, stage, case).passed)

    def _confirmed(
        self, session: Session, stage: Stage, verdict: StageVerdict, explanation: Explanation
    ) -> StageVerdict | None:
        """Write the witness into the verdict if this submission gets it wrong too; None if it does not."""
        if explanation.witness is None:
            return explained(verdict, explanation.facts)
        reply = self._ask(session, stage, explanation.witness)
        if reply.passed or reply.failure is not None:
            return None
        task = single(stage, explanation.witness)
        _, message = evidence.why(task, 0, reply)
        return explained(verdict, explanation.facts, message, evidence.counterexample(task, 0, reply))

    def _ask(self, session: Session, stage: Stage, case: Case) -> Reply:
        task = single(stage, case)
        first = session.call(self.plan.batch(stage, stage.calls(case)))
        return judged(session, self.plan, task, first)

    def _facts(self, session: Session, stage: Stage) -> list[str]:
        answers: list[Answered] = []
        for task in self.plan.tasks_of(self.plan.stage(stage.name)):
            outputs = session.run(task.batch)
            if not isinstance(outputs, Outputs):
                return []
            reply = judged(session, self.plan, task, outputs)
            for index, case in enumerate(task.cases):
                answers.append(Answered(case, bool(reply.right[index]), _got(task, index, outputs)))
        return facts(stage, answers)

    def _probed(self, session: Session, stage: Stage) -> list[str]:
        if stage.name not in {"residual", "jacobian", "information_matrix", "gauss_newton_step"}:
            return []
        found = [probe.read(self._values(session, probe)) for probe in probes(stage.function)]
        if stage.name == "jacobian":
            of_jacobian, of_residual, read = derivative_probe()
            found.append(read(self._values(session, of_jacobian), self._values(session, of_residual)))
        return [sentence for sentence in found if sentence]

    def _values(self, session: Session, probe: Probe) -> Values:
        stage = next(stage for stage, _ in self.plan.stages if stage.function == probe.function)
        outputs = session.call(self.plan.batch(stage, probe.calls))
        if not isinstance(outputs, Outputs):
            return [None] * len(probe.calls)
        return [
            array_of(outputs, index) if outputs.outcome[index] == Outcome.OK else None
            for index in range(len(probe.calls))
        ]


def _got(task: Task, index: int, outputs: Outputs) -> tuple[np.ndarray, ...] | None:
    """Return the arrays of the first call of a case, where they have the expected shapes."""
    first = int(task.first_calls[index])
    if outputs.outcome[first] != Outcome.OK:
        return None
    parts = task.stage.parts
    wanted = task.stage.layout(task.prepared).shapes
    numbers = range(first * parts, (first + 1) * parts)
    if not all(fits(outputs.shapes[number], wanted[number]) for number in numbers):
        return None
    return tuple(array_of(outputs, number) for number in numbers)


def _slip_is_wrong(stage: Stage, slip: Slip, case: Case) -> bool:
    """Judge a slip on one case in this process: it is our own code."""
    answers = _answers([trusted_call(slip.function, call, stage.parts) for call in stage.calls(case)], stage.parts)
    if answers is None:
        return True
    prepared = stage.prepare((case,))
    calls = stage.follow_up(prepared, answers)
    again = None
    if calls is not None:
        again = _answers([trusted_call(slip.function, call, stage.parts) for call in calls], stage.parts)
        if again is None:
            return True
    return not stage.judge(prepared, answers, again).all()


def _answers(values: list[tuple[np.ndarray, ...] | None], parts: int) -> evidence.Joined | None:
    arrays = [array for value in values if value is not None for array in value]
    if len(arrays) != len(values) * parts:
        return None
    return evidence.Joined(
        outcome=np.zeros(len(values), dtype=np.uint8),
        shapes=[array.shape for array in arrays],
        offsets=np.concatenate([[0], np.cumsum([array.size for array in arrays])]).astype(np.int64),
        data=np.concatenate([array.ravel() for array in arrays]),
    )


def explained(
    verdict: StageVerdict,
    found: tuple[str, ...],
    message: str = "",
    counterexample: dict[str, Any] | None = None,
) -> StageVerdict:
    """Write a witness into the first check that earned nothing, and the facts before its message."""
    checks = list(verdict.checks)
    first = next(index for index, check in enumerate(checks) if not check.passed and not check.points)
    if message:
        checks[first] = replace(checks[first], message=message, counterexample=counterexample)
    before = verdict.message.removesuffix(verdict.checks[first].message).strip()
    words = " ".join(part for part in (before, *found, checks[first].message) if part)
    return replace(verdict, checks=tuple(checks), message=words)
