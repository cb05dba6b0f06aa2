"""Say more about wrong answers, with nothing asked again: the known mistake, the case that shows it, style.

Everything here comes after the marks and can only add words; each step is an attempt.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from msgspec.structs import replace

from autograder.attempts import Attempts
from autograder.diagnosis.recognise import CLOSE, COARSE, Given, Recogniser
from autograder.engine.collect import Absent, Collected, Reply
from autograder.engine.evidence import plainly, simplest
from autograder.engine.groups import digest
from autograder.engine.plan import Plan, Task
from autograder.engine.rows import RowsOf, priors_last
from autograder.engine.showing import counterexample, why
from autograder.sandbox.frames import Kind
from autograder.sandbox.host import Outputs
from autograder.stages.base import Slip, Stage
from autograder.stages.catalogue import slips
from autograder.verdicts import CheckVerdict, StageVerdict

_REMARKS = {
    Kind.LIST: "returns a list; a numpy array is expected, and the list was converted.",
    Kind.MATRIX: "returns np.matrix; a plain array is expected, and the matrix was converted.",
    Kind.INTEGER_ARRAY: "returns integers; real numbers are expected, and they were converted.",
    Kind.BOOL_ARRAY: "returns truth values; real numbers are expected, and they were converted.",
    Kind.FLOAT32_ARRAY: "returns numbers of reduced precision; float64 is expected.",
}


# The mistakes of whom has whitened f and J and set Omega to the identity: together they fit.
_WHITENED = {
    "residual": "residual_whitened",
    "jacobian": "jacobian_whitened",
    "information_matrix": "identity_used_as_information",
}
_FITS = "Your f and J are whitened and your Omega is the identity: together they give the right H, b and step."
_UNWHITEN = (
    "Whitening is a good thing elsewhere; here f is in metres, J has no unit, and the certainty of each measurement "
    "stands in Omega alone."
)


class Describer:
    """Describes submissions of one run; remembers what known mistakes answer, so that it is worked out once."""

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self._rows = RowsOf(plan)
        self._recognisers: dict[str, Recogniser] = {}

    def describe(self, collected: Collected, verdicts: Sequence[StageVerdict], attempt: Attempts) -> list[StageVerdict]:
        """Describe every stage of one submission; points and status stay as they are."""
        white = bool(attempt("comparing f, J and Omega", self._rows.whitened, collected))
        return [
            self._stage(verdict, collected, attempt, white=white) if self.plan.has(verdict.name) else verdict
            for verdict in verdicts
        ]

    def _stage(self, verdict: StageVerdict, collected: Collected, attempt: Attempts, *, white: bool) -> StageVerdict:
        stage = self.plan.stage(verdict.name)
        tasks = self.plan.tasks_of(stage)
        replies = [collected.reply(task) for task in tasks]
        style = attempt(f"remarking on {stage.name}", remarks, tasks, replies) or ()
        verdict = replace(verdict, remarks=(*verdict.remarks, *style))
        verdict = _shown(verdict, tasks, replies, attempt)
        if verdict.status in {"passed", "missing"} or any(isinstance(reply.failure, Absent) for reply in replies):
            return verdict
        group = attempt(f"grouping {stage.name}", digest, tasks, replies) or ""
        followed = all(check.passed or check.points for check in verdict.checks)
        if white and stage.name in _WHITENED:
            slip = next(each for each in slips(stage.name) if each.identifier == _WHITENED[stage.name])
            words = f"{slip.name} {_FITS} {verdict.message}".strip()
            return replace(verdict, group=group, slip=slip.identifier, hint=_UNWHITEN, message=words)
        named = None if followed else attempt(f"naming the mistake in {stage.name}", self._named, stage, tasks, replies)
        if named is None:
            return replace(verdict, group=group)
        slip, before = named
        words = f"{before}{slip.name} {verdict.message}".strip()
        return replace(verdict, group=group, slip=slip.identifier, hint=slip.hint, message=words)

    def _named(self, stage: Stage, tasks: Sequence[Task], replies: Sequence[Reply]) -> tuple[Slip, str] | None:
        """Return the known mistake, with what is to be said before its name."""
        outputs = [reply.outputs for reply in replies if isinstance(reply.outputs, Outputs)]
        if [len(each.outcome) for each in outputs] != [len(task.asked) for task in tasks]:
            return None  # failed, or asked on one simple case only: too little to name it by
        known = self._recognisers.get(stage.name)
        if known is None:
            calls = [call for task in tasks for case in task.cases for call in stage.calls(case)]
            starts = np.cumsum([0, *(len(task.asked) for task in tasks)])
            same_as = np.concatenate([start + task.same_as for start, task in zip(starts, tasks, strict=False)])
            known = self._recognisers.setdefault(stage.name, Recogniser(stage, calls, same_as))
        coarse = any(Kind.FLOAT32_ARRAY in each.kinds.tobytes() for each in outputs)
        given, close = _joined(outputs), COARSE if coarse else CLOSE
        found = known.recognise(given, close)
        if found is not None:
            return found, ""
        moved = priors_last(known.calls, given) if stage.name in _WHITENED else None
        found = None if moved is None else known.recognise(moved, close)
        return None if found is None else (found, "The rows of the priors come first, and not only that. ")


def _joined(outputs: Sequence[Outputs]) -> Given:
    """Lay the batches of one stage end to end."""
    sizes = np.cumsum([0, *(len(each.data) for each in outputs)])
    offsets = [each.offsets[:-1] + start for each, start in zip(outputs, sizes[:-1], strict=True)]
    return Given(
        outcome=np.concatenate([each.outcome for each in outputs]),
        shapes=[shape for each in outputs for shape in each.shapes],
        offsets=np.concatenate([*offsets, sizes[-1:]]),
        data=np.concatenate([each.data for each in outputs]),
    )


def _shown(verdict: StageVerdict, tasks: Sequence[Task], replies: Sequence[Reply], attempt: Attempts) -> StageVerdict:
    """Put into every failed check, and into the message, what is wrong with the simplest case that is."""
    checks, message = list(verdict.checks), verdict.message
    first = next((number for number, check in enumerate(checks) if not check.passed), -1)
    for number, (check, task, reply) in enumerate(zip(verdict.checks, tasks, replies, strict=True)):
        if check.passed or reply.failure is not None:
            continue
        found = attempt(f"showing a case of {verdict.name}", _case, check, task, reply)
        if found is not None:
            checks[number] = found
            message = swapped(message, check.message, found.message) if number == first else message
    return replace(verdict, checks=tuple(checks), message=message)


def _case(check: CheckVerdict, task: Task, reply: Reply) -> CheckVerdict:
    index = simplest(task, ~reply.right)
    sentence = swapped(check.message, plainly(task, index, reply)[1], why(task, index, reply))
    return replace(check, message=sentence, counterexample=counterexample(task, index, reply))


def swapped(text: str, old: str, new: str) -> str:
    """Put other words in the place of those that a text ends with."""
    return text.removesuffix(old) + new if old and text.endswith(old) else text


def remarks(tasks: Sequence[Task], replies: Sequence[Reply]) -> tuple[str, ...]:
    """Remark on style, at no cost: lists, columns, np.matrix, integers, arguments changed in place."""
    found: dict[str, None] = {}
    for task, reply in zip(tasks, replies, strict=True):
        outputs = reply.outputs
        if not isinstance(outputs, Outputs):
            continue
        function = task.stage.function
        met = set(outputs.kinds.tobytes()) - ({Kind.BOOL_ARRAY} if task.stage.takes_truth else set())
        if not all(each.passed for each in replies):
            met -= {Kind.FLOAT32_ARRAY}  # where it costs points it is no matter of style
        for kind in sorted(met & _REMARKS.keys()):
            found[f"{function} {_REMARKS[Kind(kind)]}"] = None
        if outputs.reshaped:
            found[f"{function} returns a column or a row; a vector is expected, and it was read as one."] = None
        if outputs.mutated >= 0:
            found[f"{function} changes its argument in place; work on a copy."] = None
    return tuple(found)
