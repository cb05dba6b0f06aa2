"""What one case got back, call by call, and the plain sentence about it that needs no knowledge of the mistake."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from autograder.engine.collect import Reply
from autograder.engine.normal import array_of
from autograder.engine.plan import Task
from autograder.problems.cases import Case
from autograder.sandbox.frames import Outcome
from autograder.sandbox.host import Outputs
from autograder.stages.base import Array, Shape, Stage
from autograder.stages.wording import number

_ONE_OF_TWO = re.compile(r"value ([12]) of 2: (.*)")  # as the child says it
_ARGUMENTS = {
    "normal_equations": ("J", "omega", "f"),
    "information_matrix": ("graph",),
    "sparsity_pattern": ("graph",),
    "range_residual": ("x", "ranging"),
    "range_jacobian": ("x", "ranging"),
}
PARTS = {"normal_equations": ("H", "b"), "sparsity_pattern": ("J_mask", "H_mask")}


@dataclass(frozen=True)
class Came:
    """What one call gave.

    `arrays` are all that it returned, none where it gave no numbers. `again` marks the call of a second round.
    """

    arguments: Case
    outcome: Outcome
    reason: str
    arrays: tuple[Array, ...]
    again: bool = False


def came(task: Task, index: int, reply: Reply) -> list[Came]:
    """List what the calls of one case gave, the second round last."""
    assert isinstance(reply.outputs, Outputs)
    calls = task.stage.calls(task.cases[index])
    first = int(task.first_calls[index])
    found = [_came(reply.outputs, first + place, task.stage, call) for place, call in enumerate(calls)]
    if isinstance(reply.again, Outputs):
        later = task.stage.follow_up(task.prepared, reply.outputs) or []
        found.append(_came(reply.again, index, task.stage, later[index], again=True))
    return found


def _came(outputs: Outputs, call: int, stage: Stage, arguments: Case, *, again: bool = False) -> Came:
    parts = range(call * stage.parts, (call + 1) * stage.parts)
    outcome = Outcome(int(outputs.outcome[call]))
    arrays = [array_of(outputs, part) for part in parts] if outcome is Outcome.OK else []
    return Came(
        arguments, outcome, outputs.reasons.get(call, ""), tuple(each for each in arrays if each is not None), again
    )


def simplest(task: Task, chosen: NDArray[np.bool_]) -> int:
    """Return the number of the simplest of the chosen cases."""
    found = np.flatnonzero(chosen)
    return int(found[np.argmin(task.order[found])])


def plainly(task: Task, index: int, reply: Reply) -> tuple[Outcome, str]:
    """Say what came and what was expected: the first call without usable numbers, else the number furthest off.

    The outcome is OK where every call returned finite numbers of the right shape, and BAD_VALUE where one did not.
    """
    calls = came(task, index, reply)
    unusable = (_unusable(task.stage, call) for call in calls)
    found = next((each for each in unusable if each is not None), None)
    return found or (Outcome.OK, _furthest(task.stage, [call for call in calls if not call.again]))


def telling(task: Task, index: int, reply: Reply) -> Came:
    """Return the call of a case that a reader should see: the first without usable numbers, else the first."""
    calls = came(task, index, reply)
    return next((call for call in calls if _unusable(task.stage, call) is not None), calls[0])


def _unusable(stage: Stage, call: Came) -> tuple[Outcome, str] | None:
    """Say why a call gave no usable numbers; None where it did."""
    function = f"{stage.function}(x + dx(x), graph)" if call.again else stage.function
    wanted = stage.shapes(*call.arguments)
    whats = [f"{name} of {function}" if name else function for name in _names(stage)]
    if call.outcome is Outcome.BAD_VALUE:
        came = call.reason or "no numbers"
        return call.outcome, _refused(whats, wanted, came) or f"{function} returned {came}."
    if call.outcome is not Outcome.OK:
        return call.outcome, _odd(function, call.outcome, call.reason)
    for what, array, shape in zip(whats, call.arrays, wanted, strict=True):
        if array.shape != shape:
            return Outcome.BAD_VALUE, f"{what} returned shape {array.shape}, expected {shape}."
        if not np.isfinite(array).all():
            word = "nan" if np.isnan(array).any() else "inf"
            return Outcome.BAD_VALUE, f"{what} returned {word}, expected finite numbers."
    return None


def _refused(whats: Sequence[str], wanted: Sequence[Shape], said: str) -> str:
    """Say which value is no array of real numbers, or too large to be sent; "" where all together is no pair."""
    found = _ONE_OF_TWO.fullmatch(said) if len(whats) > 1 else None
    part, came = (int(found[1]) - 1, found[2]) if found else (0, said)
    if len(whats) > 1 and not found:
        return ""
    if came.startswith("shape"):
        return f"{whats[part]} returned {came}, expected {wanted[part]}."
    return f"{whats[part]} returned {came}; expected an array of real numbers, shape {wanted[part]}."


def _odd(function: str, outcome: Outcome, reason: str) -> str:
    if outcome is Outcome.UNFINISHED:
        return f"{function} is unfinished: it raises NotImplementedError."
    if outcome is Outcome.FORBIDDEN:
        return f"{function} uses the module {reason or '(unknown)'}, which is not allowed here; numpy is."
    if outcome is Outcome.MEMORY:
        return f"{function} needs more memory than it is given."
    called = function if "(" in function else called_as(function)
    return f"{called} raised {reason or 'an exception'}."


def called_as(function: str) -> str:
    """Write the call that is made.

    Examples
    --------
    >>> called_as("residual"), called_as("normal_equations")
    ('residual(x, graph)', 'normal_equations(J, omega, f)')
    """
    return f"{function}({', '.join(arguments(function))})"


def arguments(function: str) -> tuple[str, ...]:
    """Return the names of the arguments of a function."""
    return _ARGUMENTS.get(function, ("x", "graph"))


def _names(stage: Stage) -> Sequence[str]:
    return PARTS.get(stage.function, ("",) * stage.parts)


def _furthest(stage: Stage, calls: Sequence[Came]) -> str:
    """Show the number that is furthest from the reference's; all are finite and have the right shape."""
    worst, words = 0.0, f"the numbers of {stage.function} are not as expected."
    for call in calls:
        for name, got, wanted in zip(_names(stage), call.arrays, stage.expected(*call.arguments), strict=True):
            gap = np.abs(got - wanted)
            if gap.size and gap.max() > worst:
                worst, place = float(gap.max()), np.unravel_index(int(gap.argmax()), gap.shape)
                where = f"{name}[{', '.join(str(int(each)) for each in place)}]"
                words = f"{stage.function} returned {where} = {_beside(got[place], wanted[place], worst)}."
    return words


def _beside(got: float, wanted: float, gap: float) -> str:
    """Write two numbers side by side; where they print alike, how far apart they are."""
    mine, right = number(float(got)), number(float(wanted))
    return f"{mine}, expected {right}" + (f", which is {gap:.2g} away" if mine == right else "")
