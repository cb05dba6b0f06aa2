"""Behaviour groups: submissions whose wrong answers to a stage agree on the whole corpus have one digest."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence

import numpy as np

from autograder.engine.collect import Reply
from autograder.engine.plan import Task
from autograder.sandbox.host import Outputs

DIGITS = 6


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
        rounded = significant(outputs.data)
        parts = len(outputs.shapes) // max(len(outputs.outcome), 1)
        calls_of = np.append(task.first_calls, len(outputs.outcome)) * parts
        for index in np.flatnonzero(~reply.right):
            for number in range(calls_of[index], calls_of[index + 1]):
                values = rounded[outputs.offsets[number] : outputs.offsets[number + 1]]
                found.update(repr(outputs.shapes[number]).encode() + values.tobytes())
    return found.hexdigest()[:16]


def significant(values: np.ndarray) -> np.ndarray:
    """Round to six significant digits.

    Examples
    --------
    >>> significant(np.array([1234567.0, -0.0, 1e-30, 0.12345678]))
    array([1.23457e+06, 0.00000e+00, 0.00000e+00, 1.23457e-01])
    """
    with np.errstate(all="ignore"):
        size = np.floor(np.log10(np.maximum(np.abs(values), 1e-12)))
        scale = 10.0 ** (DIGITS - 1 - size)
        kept = np.where(np.abs(values) < 1e-12, 0.0, np.round(values * scale) / scale)
    return np.asarray(np.where(np.isfinite(values), kept, values) + 0.0)
