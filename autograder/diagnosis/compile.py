"""Compile the gallery: what the known mistakes get wrong, reduced, and what the strategies of witnesses draw."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence

from autograder.diagnosis.recognise import Given, laid_out, trusted_call
from autograder.diagnosis.witness import smallest_witness
from autograder.problems.cases import Case, key, simplicity
from autograder.problems.draw import draw_distinct
from autograder.problems.plain import plain
from autograder.problems.witnesses import DRAWN
from autograder.stages.base import Slip, Stage
from autograder.stages.catalogue import all_stages, slips

Gallery = Mapping[str, Sequence[Case]]


def draw_gallery() -> Gallery:
    """Draw and reduce all small cases, ladder by ladder, from simple to rich."""
    found: dict[str, dict[bytes, Case]] = {ladder: {} for ladder in DRAWN}
    for ladder, strategies in DRAWN.items():
        for number, (strategy, count) in enumerate(strategies):
            for case in draw_distinct(strategy, count, f"gallery/{ladder}/{number}"):
                found[ladder].setdefault(key(case), case)
    for stage in all_stages():
        for slip in slips(stage.name):
            witness = slip_witness(stage, slip)
            if witness is not None:
                found[stage.ladder.name].setdefault(key(witness), witness)
    return {ladder: sorted(cases.values(), key=simplicity) for ladder, cases in found.items()}


def written(cases: Gallery) -> bytes:
    """Write a gallery as JSON, one case a line, so that a change of one case is a change of one line."""
    ladders = []
    for ladder, found in sorted(cases.items()):
        lines = ",\n".join(json.dumps([plain(each) for each in case]) for case in found)
        ladders.append(f"{json.dumps(ladder)}: [\n{lines}\n]")
    return ("{\n" + ",\n".join(ladders) + "\n}\n").encode()


def slip_witness(stage: Stage, slip: Slip) -> Case | None:
    """Return the smallest case that a known mistake gets wrong; None where no small case shows it."""
    return smallest_witness(stage.ladder.name, lambda case: slip_is_wrong(stage, slip, case))


def slip_is_wrong(stage: Stage, slip: Slip, case: Case) -> bool:
    """Judge a slip on one case in this process: it is our own code."""
    if slip.remembers:
        slip.function.__dict__.clear()
    answers = _answers(stage, slip, stage.calls(case))
    if answers is None:
        return True
    prepared = stage.prepare((case,))
    calls = stage.follow_up(prepared, answers)
    again = None
    if calls is not None:
        again = _answers(stage, slip, calls)
        if again is None:
            return True
    return not stage.judge(prepared, answers, again).all()


def _answers(stage: Stage, slip: Slip, calls: Sequence[Case]) -> Given | None:
    values = [trusted_call(slip.function, call, stage.parts) for call in calls]
    return (
        None if any(value is None or len(value) != stage.parts for value in values) else laid_out(values, stage.parts)
    )
