"""What came back, brought to the shapes that were asked for: once, before anybody reads it.

Many students return columns. A column or a row that can stand for a vector becomes that vector here, so that
judging, recognising, grouping, probing and showing all see the same arrays. Numbers are float64 already:
integers, truth values, np.matrix and single precision are read as such on the way, without loss.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from itertools import pairwise

from autograder.engine.plan import Plan
from autograder.problems.cases import Case
from autograder.sandbox.host import Failure, Outputs, Session
from autograder.stages.base import Array, Shape, Stage


def put(session: Session, plan: Plan, stage: Stage, calls: list[Case]) -> Outputs | Failure:
    """Ask calls that are in no batch of the plan, and normalise what comes back."""
    outputs = session.call(plan.batch(stage, calls))
    return outputs if isinstance(outputs, Failure) else normalised(outputs, shapes_of(stage, calls))


def shapes_of(stage: Stage, calls: Iterable[Case]) -> list[Shape]:
    """Return the expected shapes of all arrays of some calls."""
    return [shape for call in calls for shape in stage.shapes(*call)]


def normalised(outputs: Outputs, wanted: list[Shape]) -> Outputs:
    """Give every array that can stand for the wanted one its shape; all others stay as they came."""
    if outputs.shapes == wanted:
        return outputs
    shapes = [want if fits(shape, want) else shape for shape, want in zip(outputs.shapes, wanted, strict=True)]
    if shapes == outputs.shapes:
        return outputs
    was = next(shape for shape, now in zip(outputs.shapes, shapes, strict=True) if shape != now)
    return replace(outputs, shapes=shapes, reshaped="column" if was[1] == 1 else "row")


def fits(shape: Shape, wanted: Shape) -> bool:
    """Whether an array of this shape can stand for the wanted one.

    Examples
    --------
    >>> fits((6, 1), (6,)), fits((1, 6), (6,)), fits((5, 6), (6, 5)), fits((), (1,))
    (True, True, False, False)
    """
    return shape == wanted or (len(wanted) == 1 and shape in ((wanted[0], 1), (1, wanted[0])))


def array_of(outputs: Outputs, number: int) -> Array | None:
    """Return one returned array in its shape; None where its call gave no numbers."""
    values = outputs.data[outputs.offsets[number] : outputs.offsets[number + 1]]
    shape = outputs.shapes[number]
    return values.reshape(shape) if values.size == math.prod(shape) else None


def arrays_of(outputs: Outputs) -> list[Array]:
    """Return all arrays of calls that all gave numbers, each in its shape."""
    spans = pairwise(outputs.offsets.tolist())
    return [outputs.data[a:b].reshape(shape) for (a, b), shape in zip(spans, outputs.shapes, strict=True)]
