"""The graphs that are kept apart show what the exam shows, so that nothing is right there that is wrong here."""

from __future__ import annotations

import numpy as np
import pytest

from autograder.engine.corpus import draw_corpus
from autograder.problems.apart import ladder_apart, set_apart, structure
from autograder.problems.cases import key
from autograder.problems.graphs import loop_edges, well_posed
from autograder.stages.catalogue import all_stages, slips, stage
from reference_solution import slam1d
from tests.stages.answering import verdicts

STEPS = [each for each in all_stages() if each.builds_on]
EVERY = [(step.name, slip) for step in STEPS for slip in slips(step.name)]


@pytest.fixture(scope="module")
def corpus():
    """A small exam."""
    return draw_corpus(all_stages(), 5, 40).cases


def passed(step, rungs, function) -> set[str]:
    """Return the checks in which a trusted step is right; one that raises or returns another shape is not."""
    found = set()
    for name, cases in rungs.items():
        getattr(function, "__dict__", {}).clear()
        try:
            right = verdicts(step, cases, function)
        except (ValueError, IndexError, np.linalg.LinAlgError):
            continue
        found |= {name} if right.all() else set()
    return found


@pytest.mark.parametrize(("name", "slip"), EVERY, ids=[f"{name}-{slip.identifier}" for name, slip in EVERY])
def test_a_mistake_in_the_step_shows_wherever_the_exam_shows_it(corpus, name, slip):
    """No check is passed by itself that the exam does not pass, for any known mistake in a step."""
    step = stage(name)
    with np.errstate(all="ignore"):
        here = passed(step, corpus[step.ladder.name], slip.function)
        apart = passed(step, corpus[ladder_apart(step.ladder.name)], slip.function)
    assert apart <= here


def test_the_reference_is_right_on_all_of_them(corpus):
    """Every case of every check."""
    for step in STEPS:
        rungs = corpus[ladder_apart(step.ladder.name)]
        assert passed(step, rungs, slam1d.gauss_newton_step) == set(rungs)


@pytest.mark.parametrize("seed", range(3))
def test_they_are_new_and_keep_what_a_case_shows(seed):
    """Another structure than any graph of the exam, as many loops and priors, and all of the core, well posed."""
    cases = draw_corpus(all_stages(), seed, 20).cases
    exam = [case for name in ("graphs", "loops") for found in cases[name].values() for case in found]
    used = {structure(graph) for _, graph in exam}
    for name in ("graphs", "loops"):
        for rung in stage_rungs(name):
            found = cases[ladder_apart(name)][rung.name]
            assert len(found) >= len(rung.core)
            for (x, graph), (_, old) in zip(found, cases[name][rung.name][: len(rung.core)], strict=False):
                assert structure(graph) not in used
                assert well_posed(x, graph)
                assert len(graph.priors) == len(old.priors)
                assert len(graph.edges) - graph.n_poses == len(old.edges) - old.n_poses
                assert name == "graphs" or loop_edges(graph)


def stage_rungs(ladder):
    """Return the rungs of a ladder."""
    return next(each.ladder for each in all_stages() if each.ladder.name == ladder).rungs


def test_the_seed_decides(corpus):
    """The same stream gives the same cases, and another one gives others."""
    rungs = {"single_loops": corpus["graphs"]["single_loops"]}
    graphs = [graph for _, graph in rungs["single_loops"]]
    one, same, other = (set_apart(rungs, {"single_loops": 6}, graphs, stream) for stream in ("a", "a", "b"))
    keys = [[key(case) for case in found["single_loops"]] for found in (one, same, other)]
    assert keys[0] == keys[1]
    assert not set(keys[0]) & set(keys[2])
