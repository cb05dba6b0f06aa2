"""Behaviour groups: submissions whose wrong answers to a stage agree on the whole corpus have one digest."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence

import numpy as np

from autograder.engine.collect import Reply
from autograder.engine.plan import Task
from autograder.engine.settle import settled
from autograder.sandbox.host import Outputs

DIGITS, NOISE = 6, 1e-9


def digest(tasks: Sequence[Task], replies: Sequence[Reply]) -> str:
    """Identify what a submission answered to one stage.

    A right case counts as right however it is rounded; the numbers of a wrong one count to six
    significant digits, so that two ways to compute the same wrong thing fall into one group.
    """
    found = hashlib.sha256()
    for task, reply in zip(tasks, replies, strict=True):
        if reply.failure is not None or not isinstance(reply.outputs, Outputs):
            found.update(f"{task.rung.name}:{reply.failure.reason if reply.failure else ''};".encode())
            continue
        outputs = reply.outputs
        found.update(reply.right.tobytes() + outputs.outcome.tobytes())
        parts = len(outputs.shapes) // max(len(outputs.outcome), 1)
        calls_of = np.append(task.first_calls, len(outputs.outcome)) * parts
        for index in np.flatnonzero(~reply.right):
            for number in range(calls_of[index], calls_of[index + 1]):
                values = settled(outputs.data[outputs.offsets[number] : outputs.offsets[number + 1]])
                rounded = settled(
                    values, DIGITS, NOISE
                )  # twice: what lies between two steps goes the same way everywhere
                found.update(repr(outputs.shapes[number]).encode() + rounded.tobytes())
    return found.hexdigest()[:16]
