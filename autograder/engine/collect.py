"""Ask one submission everything: run every batch of the plan in its child, and keep what came back."""

from __future__ import annotations

from dataclasses import dataclass, field

from autograder.engine.plan import Plan, Task
from autograder.sandbox.host import Failure, Loaded, Outputs, Session


@dataclass(frozen=True)
class Reply:
    """What came back for one check: numbers, or the reason why there are none.

    `again` is the second round of calls, for a stage that asks one.
    """

    outputs: Outputs | Failure
    again: Outputs | Failure | None = None

    @property
    def failure(self) -> Failure | None:
        """The first reason why numbers are missing."""
        for part in (self.outputs, self.again):
            if isinstance(part, Failure):
                return part
        return None


@dataclass(frozen=True)
class Collected:
    """All that one submission answered.

    `replies` goes by the number of the batch; a stage whose function is not defined has none.
    """

    loaded: Loaded
    replies: dict[int, Reply] = field(default_factory=dict)

    @property
    def ran_out(self) -> bool:
        """Whether anything ran out of time: such a submission is run once more, alone."""
        failures = [reply.failure for reply in self.replies.values()]
        late = any(failure is not None and failure.reason in {"timeout", "budget"} for failure in failures)
        return late or any(note.status == "timeout" for note in self.loaded.notes)


def collect(session: Session, plan: Plan) -> Collected:
    """Load the submission and run every check; a stage that hangs or dies costs only itself."""
    loaded = session.load()
    collected = Collected(loaded)
    for stage, tasks in plan.stages:
        if stage.function not in loaded.functions:
            continue
        for task in tasks:
            reply = _ask(session, plan, task)
            collected.replies[task.batch] = reply
            if reply.failure is not None:  # the rest of the stage would end the same way
                collected.replies.update({later.batch: reply for later in tasks if later.batch > task.batch})
                break
    return collected


def _ask(session: Session, plan: Plan, task: Task) -> Reply:
    outputs = session.run(task.batch)
    if isinstance(outputs, Failure):
        return Reply(outputs)
    calls = task.stage.follow_up(task.prepared, outputs)
    if calls is None:
        return Reply(outputs)
    return Reply(outputs, session.call(plan.batch(task.stage, calls)))
