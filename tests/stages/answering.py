"""Answers of a trusted function, laid out as the sandbox lays them out."""

from dataclasses import dataclass

import numpy as np

from autograder.stages.base import Stage
from autograder.stages.second_step import SecondStep


@dataclass
class Answers:
    """What the judge is given."""

    outcome: np.ndarray
    shapes: list
    offsets: np.ndarray
    data: np.ndarray


def answer(function, calls, parts=1) -> Answers:
    """Call a function on fresh copies and lay out what it returns."""
    arrays = []
    for call in calls:
        value = function(*(each.copy() if isinstance(each, np.ndarray) else each for each in call))
        arrays += [np.asarray(part, dtype=float) for part in (value if parts > 1 else (value,))]
    return Answers(
        outcome=np.zeros(len(calls), dtype=np.uint8),
        shapes=[array.shape for array in arrays],
        offsets=np.concatenate([[0], np.cumsum([array.size for array in arrays])]).astype(np.int64),
        data=np.concatenate([array.ravel() for array in arrays]),
    )


def verdicts(stage: Stage, cases, function) -> np.ndarray:
    """Judge a trusted function on cases, second round included."""
    return stage.judge(*_rounds(stage, cases, function))


def properties(stage: SecondStep, case, function) -> np.ndarray:
    """Say which of the four properties hold for a trusted step on one loop."""
    return stage.properties(*_rounds(stage, [case], function))[:, 0]


def _rounds(stage, cases, function):
    prepared = stage.prepare(cases)
    answers = answer(function, [call for case in cases for call in stage.calls(case)], stage.parts)
    calls = stage.follow_up(prepared, answers)
    return prepared, answers, None if calls is None else answer(function, calls, stage.parts)
