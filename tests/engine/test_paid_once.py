"""A mistake is paid for once: every known mistake, alone in a right submission, costs its own stage and no more."""

from __future__ import annotations

import inspect
from dataclasses import replace

import numpy as np
import pytest

from autograder.engine.answering import judge_answers
from autograder.engine.collect import collect
from autograder.engine.follow import EARLIER, STAGE, follow
from autograder.engine.judge import Judge
from autograder.problems.conclusion import RIGHT, choices
from autograder.problems.variants import published
from autograder.sandbox.frames import Source
from autograder.sandbox.host import Limits, Sandbox
from autograder.stages.answers import Sheet
from autograder.stages.catalogue import all_stages, slips, stage
from autograder.stages.slips.submission import submission_text

EXAMPLE = published()
SHEET = Sheet(EXAMPLE.identifier, EXAMPLE.graph, EXAMPLE.iterates)
LETTER = next(each.letter for each in choices(EXAMPLE.identifier) if each.identifier == RIGHT)
STEPS = tuple(each.name for each in all_stages() if each.function == STAGE)
ITERATES = 3.0  # points

# These may cost the iterates too, and nothing else.
NO_ITERATES = "the student's own step raises or has no single solution, so there are no iterates to report"
NO_STEP = "the student's own step is zero, and no iterates follow from that"
COSTS_MORE = {
    "prior_residual_missing": NO_ITERATES,
    "residual_in_whole_numbers": NO_STEP,
    "jacobian_is_the_adjacency_matrix": NO_ITERATES,
    "jacobian_is_the_gradient": NO_ITERATES,
    "jacobian_transposed": NO_ITERATES,
    "loop_row_is_zero": NO_STEP,
    "only_first_pose_differentiated": NO_ITERATES,
    "prior_row_missing": NO_ITERATES,
    "states_kept_in_derivative": NO_ITERATES,
    "covariance_inverted_entry_by_entry": NO_ITERATES,
    "information_with_a_row_for_every_pose": NO_ITERATES,
    "prior_weight_missing": NO_ITERATES,
    "weights_fill_the_matrix": NO_ITERATES,
    "weights_in_a_vector": NO_ITERATES,
    "returned_in_the_other_order": NO_ITERATES,
}

REPORT = '''

def three_steps(graph, x):
    """Take three steps, as question 2 asks."""
    states = [x]
    for _ in range(3):
        states.append(states[-1] + np.ravel(gauss_newton_step(states[-1], graph)))
    return np.array(states)


import posegraph as given

try:
    iterates = three_steps(given.PoseGraph(*{fields!r}), np.array({start!r}))
except Exception:
    iterates = None
conclusion = {letter!r}
'''


def submission(slip, function: str) -> str:
    """Write a right submission with one mistake, which reports what its own step gives."""
    fields = [
        np.asarray(getattr(EXAMPLE.graph, name)).tolist() for name in inspect.signature(type(EXAMPLE.graph)).parameters
    ]
    return submission_text(slip, function) + REPORT.format(fields=fields, start=EXAMPLE.start.tolist(), letter=LETTER)


@pytest.fixture(scope="module")
def lost(plan):
    """A function that grades a text, and returns for every stage the points that are missing."""
    points = {**plan.points, "answers": 5.0}
    whole = replace(plan, points=points)
    judge = Judge(whole)
    with Sandbox(whole.inputs, Limits()) as sandbox:

        def run(text: str) -> dict[str, float]:
            with sandbox.open(Source("module", [text], "submission.py")) as session:
                collected = collect(session, whole, alone=True)
                follow(session, whole, collected)
                marks = list(judge.judge(collected))
                marks.append(judge_answers(whole, SHEET, collected.loaded.answers, marks, session))
            missing = {each.name: each.max_score - each.score for each in marks if not each.bonus}
            return {name: points for name, points in missing.items() if points > 0}

        yield run


EVERY = [(name, slip) for name in EARLIER for slip in slips(name)]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "slip"), EVERY, ids=[slip.identifier for _, slip in EVERY])
def test_a_known_mistake_costs_its_own_stage(lost, name, slip):
    """The functions that are called with the wrong answers keep their points, and so do the iterates."""
    missing = lost(submission(slip, name))
    assert missing.pop(name) <= stage(name).points
    if slip.identifier in COSTS_MORE:
        assert missing in ({}, {"answers": ITERATES})
    else:
        assert missing == {}


def test_the_list_of_what_costs_more_is_of_known_mistakes():
    """Whoever is on the list is in the catalogue."""
    assert set(COSTS_MORE) <= {slip.identifier for _, slip in EVERY}


def test_a_mistake_in_the_step_costs_what_the_step_is_asked_for(lost):
    """Both stages of the step, and the iterates of a step that has no points; never a function before it."""
    found = [slip for name in STEPS for slip in slips(name)]
    for slip in found[:: len(found) // 6]:
        missing = lost(submission(slip, STAGE))
        assert set(missing) <= {*STEPS, "answers"}
        assert missing.get("answers", 0.0) in (0.0, ITERATES)
        earned = any(missing.get(name, 0.0) < stage(name).points for name in STEPS)
        assert not earned or "answers" not in missing


def test_whoever_is_right_loses_nothing(lost):
    """The same submission without a mistake has every point."""
    right = slips("gauss_newton_step")[0]
    text = submission(right, STAGE).replace(f"\n\n{STAGE} = {right.identifier}\n", "\n\n")
    assert lost(text) == {}
