"""A call that several cases need is made once, and every case gets its answer."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.engine.collect import spread
from autograder.engine.corpus import draw_corpus
from autograder.engine.normal import arrays_of
from autograder.engine.plan import make_plan
from autograder.problems.cases import key
from autograder.sandbox import frames
from autograder.sandbox.host import Limits, Outputs, Sandbox
from autograder.stages.catalogue import all_stages, stage
from tests.engine.conftest import REFERENCE


def outputs(sizes: list[int], reasons: dict[int, str], mutated: int) -> Outputs:
    """Make outputs of one part whose numbers tell which call they are of."""
    return Outputs(
        outcome=np.array([call in reasons for call in range(len(sizes))], dtype=np.uint8),
        kinds=np.arange(len(sizes), dtype=np.uint8),
        shapes=[(size,) for size in sizes],
        offsets=np.cumsum([0, *sizes]),
        data=np.repeat(np.arange(len(sizes), dtype=float), sizes),
        reasons=reasons,
        mutated=mutated,
    )


@given(st.data())
def test_every_call_gets_what_the_one_that_was_asked_answered(data) -> None:
    """Shapes, numbers, outcomes, reasons and the first argument that was changed go with the call."""
    sizes = data.draw(st.lists(st.integers(0, 3), min_size=1, max_size=5))
    n = len(sizes)
    reasons = {call: f"reason {call}" for call in data.draw(st.sets(st.integers(0, n - 1)))}
    given_outputs = outputs(sizes, reasons, data.draw(st.integers(-1, n - 1)))
    asked = np.array([*range(n), *data.draw(st.lists(st.integers(0, n - 1)))])
    found = spread(given_outputs, asked)
    arrays = arrays_of(given_outputs)
    for call, (array, one) in enumerate(zip(arrays_of(found), asked.tolist(), strict=True)):
        assert array.tolist() == arrays[one].tolist()
        assert found.shapes[call] == (sizes[one],)
        assert found.outcome[call] == (one in reasons)
        assert found.kinds[call] == one
        assert found.reasons.get(call) == reasons.get(one)
    assert found.mutated == given_outputs.mutated


def test_no_call_is_made_twice_for_one_check(plan) -> None:
    """The batches of checks and galleries hold every call once."""
    batches = frames.decode(plan.inputs, frames.Inputs).batches
    for task in (*plan.tasks, *plan.galleries):
        calls = [key(call) for case in task.cases for call in task.stage.calls(case)]
        assert len(batches[task.batch].cases) == len(set(calls)) <= len(calls)
        assert [calls[first] for first in task.same_as] == calls


@pytest.mark.parametrize("rung", ["single_loops", "loops_in_graphs"])
def test_neighbours_save_a_quarter_of_the_second_step(rung: str) -> None:
    """The loops are drawn in squares: what one is asked with a measurement changed, its neighbour is asked anyway."""
    second = stage("second_step")
    made = make_plan([second], {second.name: 10.0}, draw_corpus((second,), 0, 200))
    (task,) = (task for task in made.tasks if task.rung.name == rung)
    assert len(task.cases) >= 100
    assert len(set(task.asked.tolist())) < 0.75 * len(task.asked)


def test_the_answers_are_those_of_every_call_by_itself(plan) -> None:
    """The reference in a child, spread, equals the reference here."""
    with Sandbox(plan.inputs, Limits()) as sandbox:
        source = frames.Source(kind="module", cells=[REFERENCE], name="submission.py")
        with sandbox.open(source) as session:
            session.load()
            for task in plan.tasks:
                found = spread(session.run(task.batch), task.asked)
                calls = [call for case in task.cases for call in task.stage.calls(case)]
                expected = [array for call in calls for array in task.stage.expected(*call)]
                for got, wanted in zip(arrays_of(found), expected, strict=True):
                    np.testing.assert_allclose(got, wanted, rtol=1e-9, atol=1e-9)
    assert {task.stage.name for task in plan.tasks} == {each.name for each in all_stages()}


def test_a_facet_has_the_checks_of_its_stage(plan) -> None:
    """Whichever function of a stage is wrong, the checks of the stage are found."""
    whole = plan.stage("range_factor")
    assert plan.tasks_of(whole.facet("derivatives")) == plan.tasks_of(whole)
    assert len(plan.tasks_of(whole)) == 2
