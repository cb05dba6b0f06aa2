"""Show one wrong case: what is wrong with it in the subject's words, and the whole of it as plain data."""

from __future__ import annotations

from typing import Any

import numpy as np

from assignment.posegraph import PoseGraph, Ranging
from autograder.engine.collect import Reply
from autograder.engine.evidence import arguments, came, plainly, telling
from autograder.engine.plan import Task
from autograder.engine.settle import settled
from autograder.problems.plain import plain
from autograder.sandbox.frames import Outcome

MAX_SHOWN_POSES = 10  # a larger counterexample is described in words only
Example = dict[str, Any]


def why(task: Task, index: int, reply: Reply) -> str:
    """Say in the subject's words what is wrong with a case; plainly where it has no usable numbers."""
    outcome, sentence = plainly(task, index, reply)
    if outcome is not Outcome.OK:
        return sentence
    got = [array for call in came(task, index, reply) for array in call.arrays]
    return task.stage.explain(task.cases[index], tuple(got))


def counterexample(task: Task, index: int, reply: Reply) -> Example | None:
    """Write a failing case as plain data: the arguments of the call that shows it, what came, what was expected."""
    function = task.stage.function
    call = telling(task, index, reply)
    if any(max(_extent(argument)) > MAX_SHOWN_POSES for argument in call.arguments):
        return None
    names = arguments(function)
    example: Example = {"function": function}
    example.update((name, _json(argument)) for name, argument in zip(names, call.arguments, strict=True))
    expected = [_json(settled(array)) for array in task.stage.expected(*call.arguments)]
    example["expected"] = expected[0] if len(expected) == 1 else expected
    if call.outcome is Outcome.OK:
        got = [_json(settled(array)) for array in call.arrays]
        example["got"] = got[0] if len(got) == 1 else got
    else:
        example["got"] = _said(call.outcome, call.reason)
    return example


def _said(outcome: Outcome, reason: str) -> str:
    words = {Outcome.RAISED: f"raised {reason}", Outcome.UNFINISHED: "raised NotImplementedError"}
    words[Outcome.FORBIDDEN] = f"used the module {reason}"
    words[Outcome.MEMORY] = "needed too much memory"
    return words.get(outcome, reason)


def _extent(argument: Any) -> tuple[int, ...]:
    if isinstance(argument, PoseGraph):
        return argument.n_poses, argument.n_factors
    if isinstance(argument, Ranging):
        return (len(argument.poses),)
    return tuple(argument.shape) or (0,)


def _json(argument: Any) -> Any:
    """Write an argument, or what came back, as JSON has it: nan and inf by their names."""
    data = plain(argument)
    return data if isinstance(data, dict) else _strict(data)


def _strict(value: Any) -> Any:
    """Replace nan and inf, which JSON does not have, by their names."""
    if isinstance(value, list):
        return [_strict(item) for item in value]
    return value if np.isfinite(value) else str(value)
