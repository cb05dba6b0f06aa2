"""A mistake is paid for once: a step that is wrong where an earlier function is wrong, is asked again by itself.

In a fresh child, on graphs that are used nowhere else, the earlier functions are replaced by ones that answer right
for these graphs, from numbers. The child ends with that: nothing of it is used for any other stage.
"""

from __future__ import annotations

import msgspec
import numpy as np

from autograder.engine.collect import LATE, Collected, Reply, ask
from autograder.engine.plan import Plan, Task
from autograder.sandbox.frames import Kind, Table
from autograder.sandbox.host import Failure, Outputs, Session
from autograder.stages import earlier

STAGE = "gauss_newton_step"
EARLIER = earlier.FUNCTIONS


def follow(session: Session, plan: Plan, collected: Collected) -> None:
    """Ask by itself whatever failed and builds on something that failed; the replies go to `collected.apart`.

    It takes of the same time as everything else. A step that runs out of time here is not asked again.
    """
    tasks = wanted(plan, collected)
    if not tasks:
        return
    tables = _tables(plan, collected)
    failed: dict[str, Failure] = {}
    ready = False
    for task in tasks:
        function = task.stage.function
        if function not in failed and not ready:
            trouble = session.replace(tables)
            ready = trouble is None
            if trouble is not None:
                failed[function] = trouble
        reply = Reply(failed[function]) if function in failed else ask(session, plan, task)
        collected.apart[task.stage.name, task.rung.name] = reply
        if isinstance(reply.failure, Failure):
            ready = False  # that child has ended, and its tables with it
            if reply.failure.reason in LATE:
                failed[function] = reply.failure
    session.fresh()


def wanted(plan: Plan, collected: Collected) -> list[Task]:
    """Return the checks that are to be asked by themselves."""
    if plan.follow_through == 0:
        return []
    wrong = {task.stage.name for task in plan.tasks if not collected.reply(task).passed}
    own = {(task.stage.name, task.rung.name): collected.reply(task) for task in plan.tasks}
    return [
        task
        for task in plan.apart
        if wrong & set(task.stage.builds_on)
        and task.stage.function in collected.loaded.functions
        and not own[task.stage.name, task.rung.name].passed
    ]


def _tables(plan: Plan, collected: Collected) -> list[Table]:
    """Give each table the form in which the submission's own function answers: columns, lists, np.matrix."""
    own = {stage.name: tasks for stage, tasks in plan.stages}
    tables = []
    for table in plan.tables:
        outputs = [collected.reply(task).outputs for task in own.get(table.function, ())]
        came = next((each for each in outputs if isinstance(each, Outputs) and not each.outcome.all()), None)
        tables.append(table if came is None else _formed(table, came))
    return tables


def _formed(table: Table, own: Outputs) -> Table:
    parts = len(table.shapes)
    call = int(np.argmin(own.outcome))  # one that returned numbers
    kinds = set(own.kinds[call * parts : (call + 1) * parts].tolist())
    kind = "matrix" if Kind.MATRIX in kinds else "list" if kinds == {Kind.LIST} else "array"
    return msgspec.structs.replace(table, shapes=[own.reshaped] * parts, kind=kind)
