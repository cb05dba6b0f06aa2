"""Ask one submission everything: run every batch of the plan in its child, and keep what came back."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from autograder.engine.normal import normalised, shapes_of
from autograder.engine.plan import Bundle, Plan, Task
from autograder.sandbox.frames import Outcome
from autograder.sandbox.host import Failure, Loaded, Outputs, Session

LATE = {"timeout", "budget"}  # reasons of a failure that are about time
TOGETHER = 1 / 8  # of the time of a check, for all checks of a function at once; right answers take less
ONE_CASE = 1 / 10  # of the time of a check, for one simple case


@dataclass(frozen=True)
class Absent:
    """Why there are no numbers: the submission has no such function, or somebody tried to write it in vain."""

    message: str
    reason: Literal["missing", "undefined"] = "missing"


@dataclass(frozen=True)
class Reply:
    """What came back for one check, judged: numbers, or the reason why there are none.

    `again` is the second round of calls, for a stage that asks one; `right` says for each case
    whether every call returned numbers that are judged right.
    """

    outputs: Outputs | Failure | Absent
    again: Outputs | Failure | None = None
    right: NDArray[np.bool_] = field(default_factory=lambda: np.zeros(0, dtype=np.bool_))

    @property
    def failure(self) -> Failure | Absent | None:
        """The first reason why numbers are missing."""
        for part in (self.outputs, self.again):
            if isinstance(part, Failure | Absent):
                return part
        return None

    @cached_property
    def passed(self) -> bool:
        """Whether every case is right."""
        return self.failure is None and bool(self.right.all())


@dataclass
class Collected:
    """All that one submission answered.

    `replies` goes by the number of the batch; a check whose function is not defined has none.
    `apart` goes by stage and rung: what came where a check was asked again by itself, with right
    functions in the place of the earlier ones.
    """

    loaded: Loaded
    replies: dict[int, Reply] = field(default_factory=dict)
    apart: dict[tuple[str, str], Reply] = field(default_factory=dict)
    sure: bool = True

    def reply(self, task: Task) -> Reply:
        """Return what came back for one check; a function that is not defined has answered that."""
        return self.replies.get(task.batch) or Reply(self._absent(task.stage.function))

    def _absent(self, function: str) -> Absent:
        fate = self.loaded.fates.get(function)
        if fate is None:
            return Absent(f"{function} is not defined in the submission.")
        return Absent(fate.message, "undefined" if fate.tried else "missing")

    @property
    def unsure(self) -> bool:
        """Whether anything ran out of time by the clock alone: such a submission is run once more."""
        replies = (*self.replies.values(), *self.apart.values())
        failures = [reply.failure for reply in replies if isinstance(reply.failure, Failure)]
        return not self.sure or any(failure.reason in LATE and not failure.sure for failure in failures)


def collect(session: Session, plan: Plan, *, alone: bool = False) -> Collected:
    """Load the submission and run every check; a stage that hangs or dies costs only itself.

    What used up its computing time has run out of time, however busy the machine is. What ran out
    by the clock alone is left to a run that confirms it, and so is everything after it.

    Parameters
    ----------
    session : Session
        The submission.
    plan : Plan
        The exam.
    alone : bool
        Nothing else runs on this processor: every check has its own time, and the clock is believed.
    """
    collected = Collected(session.load(), sure=session.sure)
    hung: set[str] = set()
    for stage, _ in plan.stages:
        for bundle in plan.bundles_of(stage):
            if collected.unsure and not alone:
                return collected
            function = bundle.tasks[0].stage.function  # a stage may ask several
            if function not in collected.loaded.functions:
                continue
            found = _doubted(session, plan, bundle, hung) or ({} if alone else _bundle(session, plan, bundle))
            if isinstance(found, Failure):
                collected.sure = collected.sure and (found.sure or found.reason not in LATE)
                if collected.unsure:
                    return collected
                found = {}
            found = found or _one_by_one(session, plan, bundle)
            collected.replies.update(found)
            if any(reply.failure is not None and reply.failure.reason in LATE for reply in found.values()):
                hung.add(function)
    return collected


def _doubted(session: Session, plan: Plan, bundle: Bundle, hung: set[str]) -> dict[int, Reply]:
    """Give a function one simple case where it, or what it calls, ran out of time before; {} where that ends in time.

    Whoever hangs is not waited for at full length again.
    """
    task = bundle.tasks[0]
    function = task.stage.function
    blamed = sorted(hung & {function, *task.stage.builds_on})
    if not blamed:
        return {}
    case = task.cases[int(np.argmin(task.order))]
    outputs = session.call(plan.batch(task.stage, task.stage.calls(case)[:1]), ONE_CASE)
    if not isinstance(outputs, Failure) or outputs.reason not in LATE:
        return {}
    words = (
        f"{outputs.message}, on one simple case; it was asked no more because {' and '.join(blamed)} had hung before"
    )
    return {each.batch: Reply(replace(outputs, message=words)) for each in bundle.tasks}


def _bundle(session: Session, plan: Plan, bundle: Bundle) -> dict[int, Reply] | Failure:
    """Ask several checks at once, in a part of the time of one; where that fails, it has not counted."""
    before = session.left
    outputs = session.run(bundle.batch, TOGETHER)
    if isinstance(outputs, Failure):
        session.restore(before)
        return outputs
    begins = (0, *bundle.ends[:-1])
    parts = [
        _settled(sliced(outputs, begin, end), task)
        for task, begin, end in zip(bundle.tasks, begins, bundle.ends, strict=True)
    ]
    rounds = [task.stage.follow_up(task.prepared, part) for task, part in zip(bundle.tasks, parts, strict=True)]
    calls = [call for each in rounds if each is not None for call in each]
    if not calls:
        return {task.batch: _judged(task, part, None) for task, part in zip(bundle.tasks, parts, strict=True)}
    again = session.call(plan.second_round(bundle.tasks, calls), TOGETHER)
    if isinstance(again, Failure):
        session.restore(before)
        return again
    again = normalised(again, shapes_of(bundle.tasks[0].stage, calls))
    ends = np.cumsum([len(each or ()) for each in rounds]).tolist()
    seconds = [sliced(again, *span) for span in zip((0, *ends[:-1]), ends, strict=True)]
    return {
        task.batch: _judged(task, part, second) for task, part, second in zip(bundle.tasks, parts, seconds, strict=True)
    }


def _one_by_one(session: Session, plan: Plan, bundle: Bundle) -> dict[int, Reply]:
    replies: dict[int, Reply] = {}
    failed: Reply | None = None
    for task in bundle.tasks:
        replies[task.batch] = failed or ask(session, plan, task)
        if replies[task.batch].failure is not None:
            failed = replies[task.batch]  # the rest would end the same way
    return replies


def ask(session: Session, plan: Plan, task: Task) -> Reply:
    """Ask one check, and the second round where it has one, and judge its cases."""
    outputs = session.run(task.batch)
    if isinstance(outputs, Failure):
        return Reply(outputs)
    outputs = _settled(outputs, task)
    calls = task.stage.follow_up(task.prepared, outputs)
    again = None if calls is None else session.call(plan.second_round([task], calls))
    if isinstance(again, Failure):
        return Reply(outputs, again)
    return _judged(task, outputs, None if again is None else normalised(again, shapes_of(task.stage, calls or [])))


def _settled(outputs: Outputs, task: Task) -> Outputs:
    """Give every call of a check its outputs, in the shapes that were asked for."""
    return normalised(spread(outputs, task.asked), task.stage.layout(task.prepared).shapes)


def _judged(task: Task, outputs: Outputs, again: Outputs | None) -> Reply:
    right = task.stage.judge(task.prepared, outputs, again)
    for part, firsts in ((outputs, task.first_calls), (again, np.arange(len(task.cases)))):
        if part is not None and part.outcome.any():
            right = right & np.logical_and.reduceat(part.outcome == Outcome.OK, firsts)
    return Reply(outputs, again, right)


def sliced(outputs: Outputs, first: int, last: int) -> Outputs:
    """Return the outputs of the calls from `first` up to `last`."""
    parts = len(outputs.shapes) // max(len(outputs.outcome), 1)
    offsets = outputs.offsets[first * parts : last * parts + 1]
    return Outputs(
        outcome=outputs.outcome[first:last],
        kinds=outputs.kinds[first * parts : last * parts],
        shapes=outputs.shapes[first * parts : last * parts],
        offsets=offsets - offsets[0],
        data=outputs.data[offsets[0] : offsets[-1]],
        reasons={call - first: words for call, words in outputs.reasons.items() if first <= call < last},
        mutated=outputs.mutated - first if first <= outputs.mutated < last else -1,
    )


def spread(outputs: Outputs, asked: NDArray[np.int64]) -> Outputs:
    """Give every call its outputs, those too that were answered by another call which asks the same."""
    if len(asked) == len(outputs.outcome):  # each was asked
        return outputs
    parts = len(outputs.shapes) // max(len(outputs.outcome), 1)
    arrays = (asked[:, None] * parts + np.arange(parts)).ravel()
    starts, sizes = outputs.offsets[arrays], np.diff(outputs.offsets)[arrays]
    offsets = np.concatenate([[0], np.cumsum(sizes)])
    return Outputs(
        outcome=outputs.outcome[asked],
        kinds=outputs.kinds[arrays],
        shapes=[outputs.shapes[number] for number in arrays.tolist()],
        offsets=offsets,
        data=outputs.data[np.arange(offsets[-1]) + np.repeat(starts - offsets[:-1], sizes)],
        reasons={call: outputs.reasons[one] for call, one in enumerate(asked.tolist()) if one in outputs.reasons},
        mutated=-1 if outputs.mutated < 0 else int(np.argmax(asked == outputs.mutated)),
    )
