"""The confusion matrix: what each slip answers on the corpus is recognised as that slip and no other."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from autograder.diagnosis.recognise import Given, Recogniser, laid_out, trusted_call
from autograder.engine.corpus import draw_corpus
from autograder.stages.base import Slip, Stage
from autograder.stages.catalogue import all_stages, slips

WITH_SLIPS = [stage for stage in all_stages() if slips(stage.name)]


def answers(slip: Slip, stage: Stage, calls: list[Any]) -> Given:
    """Lay what a slip returns end to end; a call that raises has an outcome that is not 0."""
    return laid_out([trusted_call(slip.function, call, stage.parts) for call in calls], stage.parts)


def confusion(stage: Stage, examples: int, seed: int = 0) -> dict[str, str | None]:
    """Return for every slip of a stage the name that its answers are given."""
    rungs = draw_corpus((stage,), seed, examples).cases[stage.ladder.name]
    calls = [call for found in rungs.values() for case in found for call in stage.calls(case)]
    recogniser = Recogniser(stage, calls, np.arange(len(calls)))
    found = {slip.identifier: recogniser.recognise(answers(slip, stage, calls)) for slip in slips(stage.name)}
    return {name: None if slip is None else slip.identifier for name, slip in found.items()}


@pytest.mark.parametrize("examples", [0, 8])
@pytest.mark.parametrize("stage", WITH_SLIPS, ids=lambda stage: stage.name)
def test_the_confusion_matrix_is_diagonal(stage: Stage, examples: int) -> None:
    """Every slip is named as itself, on the fixed core alone and with drawn cases."""
    found = confusion(stage, examples)
    assert {name: got for name, got in found.items() if got != name} == {}


@pytest.mark.parametrize("stage", WITH_SLIPS, ids=lambda stage: stage.name)
def test_what_is_right_is_no_slip(stage: Stage) -> None:
    """The reference's answers are given no name."""
    rungs = draw_corpus((stage,), 0, 0).cases[stage.ladder.name]
    calls = [call for found in rungs.values() for case in found for call in stage.calls(case)]
    right = Slip("right", "It is right.", "Nothing to find.", lambda *call: _plain(stage.expected(*call)))
    assert Recogniser(stage, calls, np.arange(len(calls))).recognise(answers(right, stage, calls)) is None


def _plain(arrays: tuple[Any, ...]) -> Any:
    return arrays if len(arrays) > 1 else arrays[0]
