"""What a failed check shows: the reason in words, the case that shows it, and remarks on style."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from assignment.posegraph import PoseGraph, Ranging
from autograder.diagnosis.recognise import Given
from autograder.engine.collect import Reply
from autograder.engine.normal import array_of
from autograder.engine.plan import Task
from autograder.problems.plain import plain
from autograder.sandbox.frames import Kind, Outcome
from autograder.sandbox.host import Outputs
from autograder.stages.base import Array

MAX_SHOWN_POSES = 10  # a larger counterexample is described in words only

_ARGUMENTS = {
    "normal_equations": ("J", "omega", "f"),
    "information_matrix": ("graph",),
    "sparsity_pattern": ("graph",),
    "range_residual": ("x", "ranging"),
    "range_jacobian": ("x", "ranging"),
}
_PARTS = {"normal_equations": ("H", "b"), "sparsity_pattern": ("J_mask", "H_mask")}

_REMARKS = {
    Kind.LIST: "returns a list; a numpy array is expected, and the list was converted.",
    Kind.MATRIX: "returns np.matrix; a plain array is expected, and the matrix was converted.",
    Kind.INTEGER_ARRAY: "returns integers; real numbers are expected, and they were converted.",
    Kind.BOOL_ARRAY: "returns truth values; real numbers are expected, and they were converted.",
    Kind.FLOAT32_ARRAY: "returns numbers of reduced precision; float64 is expected.",
}


def joined(outputs: Sequence[Outputs]) -> Given:
    """Lay the batches of one stage end to end."""
    sizes = np.cumsum([0, *(len(each.data) for each in outputs)])
    offsets = [each.offsets[:-1] + start for each, start in zip(outputs, sizes[:-1], strict=True)]
    return Given(
        outcome=np.concatenate([each.outcome for each in outputs]),
        shapes=[shape for each in outputs for shape in each.shapes],
        offsets=np.concatenate([*offsets, sizes[-1:]]),
        data=np.concatenate([each.data for each in outputs]),
    )


def why(task: Task, index: int, reply: Reply) -> tuple[Outcome, str]:
    """Say why a case failed: what the call did, or what is wrong with its numbers."""
    outputs = reply.outputs
    assert isinstance(outputs, Outputs)
    function = task.stage.function
    first = int(task.first_calls[index])
    calls = task.stage.calls(task.cases[index])
    for call in range(first, first + len(calls)):
        outcome = Outcome(int(outputs.outcome[call]))
        if outcome is not Outcome.OK:
            reason = outputs.reasons.get(call, "")
            if outcome is Outcome.BAD_VALUE and reason.startswith("shape"):  # too large to be sent at all
                shapes = [array.shape for array in task.stage.expected(*calls[call - first])]
                return outcome, f"{function} returned {reason}, expected {' and '.join(map(str, shapes))}."
            return outcome, _odd(function, outcome, reason)
    got, expected = _arrays(task, index, reply), [array for call in calls for array in task.stage.expected(*call)]
    names = _PARTS.get(function, ("",)) * len(got)
    for name, array, wanted in zip(names, got, expected, strict=False):
        what = f"{name} of {function}" if name else function
        if array.shape != wanted.shape:
            return Outcome.BAD_VALUE, f"{what} returned shape {array.shape}, expected {wanted.shape}."
        if not np.isfinite(array).all():
            return Outcome.BAD_VALUE, f"{what} returned {_not_finite(array)}, expected finite numbers."
    return Outcome.OK, task.stage.explain(task.cases[index], tuple(got))


def _odd(function: str, outcome: Outcome, reason: str) -> str:
    if outcome is Outcome.UNFINISHED:
        return f"{function} is unfinished: it raises NotImplementedError."
    if outcome is Outcome.FORBIDDEN:
        return f"{function} uses the module {reason}, which is not allowed here; numpy is."
    if outcome is Outcome.MEMORY:
        return f"{function} needs more memory than it is given."
    if outcome is Outcome.RAISED:
        return f"{function} raised {reason or 'an exception'}."
    return f"{function} returned {reason or 'no numbers'}; expected an array of real numbers."


def _not_finite(array: Array) -> str:
    return "nan" if np.isnan(array).any() else "inf"


def _arrays(task: Task, index: int, reply: Reply) -> list[Array]:
    """Return the arrays of one case with the shapes in which they came; the second round last."""
    outputs, again = reply.outputs, reply.again
    assert isinstance(outputs, Outputs)
    parts = task.stage.parts
    first = int(task.first_calls[index]) * parts
    last = first + len(task.stage.calls(task.cases[index])) * parts
    found = [array_of(outputs, number) for number in range(first, last)]
    if isinstance(again, Outputs):
        found.append(array_of(again, index))
    return [np.full(1, np.nan) if each is None else each for each in found]


def counterexample(task: Task, index: int, reply: Reply) -> dict[str, Any] | None:
    """Write a failing case as plain data: the arguments of its first call, what came, what was expected."""
    call = task.stage.calls(task.cases[index])[0]
    if any(max(_extent(argument)) > MAX_SHOWN_POSES for argument in call):
        return None
    function = task.stage.function
    outputs = reply.outputs
    assert isinstance(outputs, Outputs)
    first = int(task.first_calls[index])
    names = _ARGUMENTS.get(function, ("x", "graph"))
    example: dict[str, Any] = {"function": function}
    example.update((name, _json(argument)) for name, argument in zip(names, call, strict=True))
    expected = [_json(array) for array in task.stage.expected(*call)]
    example["expected"] = expected[0] if len(expected) == 1 else expected
    outcome = Outcome(int(outputs.outcome[first]))
    if outcome is Outcome.OK:
        got = [_json(array) for array in _arrays(task, index, reply)[: task.stage.parts]]
        example["got"] = got[0] if len(got) == 1 else got
    else:
        example["got"] = _came(outcome, outputs.reasons.get(first, ""))
    return example


def _came(outcome: Outcome, reason: str) -> str:
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


def remarks(tasks: Sequence[Task], replies: Sequence[Reply]) -> tuple[str, ...]:
    """Remark on style, at no cost: lists, columns, np.matrix, integers, arguments changed in place."""
    found: dict[str, None] = {}
    for task, reply in zip(tasks, replies, strict=True):
        outputs = reply.outputs
        if not isinstance(outputs, Outputs):
            continue
        function = task.stage.function
        met = set(outputs.kinds.tobytes()) - ({Kind.BOOL_ARRAY} if task.stage.takes_truth else set())
        for kind in sorted(met & _REMARKS.keys()):
            found[f"{function} {_REMARKS[Kind(kind)]}"] = None
        if outputs.reshaped:
            found[
                f"{function} returns a column or a row; a vector, shape (m,), is expected, and it was read as one."
            ] = None
        if outputs.mutated >= 0:
            found[f"{function} changes its argument in place; work on a copy."] = None
    return tuple(found)
