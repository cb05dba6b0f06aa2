"""Marks are final before anything is explained: whatever an explanation raises, they stand, and staff hear of it."""

from dataclasses import replace

import numpy as np
import pytest

from autograder.attempts import STRICT, only_words
from autograder.engine import describe, explain, worker
from autograder.engine.messages import Grade, Graded, Trouble
from autograder.engine.worker import Examiner
from autograder.reports.feedback import feedback_page
from autograder.reports.overview import class_page
from autograder.sandbox.frames import Source
from autograder.sandbox.host import Limits, Sandbox
from autograder.stages.catalogue import stage
from autograder.verdicts import Result
from tests.engine.conftest import REFERENCE

# Wrong in every stage, in a way of which all that can be said is said: facts, probes, small cases, remarks.
WRONG = REFERENCE + "".join(
    f"\n\n_{name} = {name}\n\ndef {name}({arguments}):\n    return 1.25 * np.asarray(_{name}({arguments})) + 0.25\n"
    for name, arguments in {"residual": "x, graph", "jacobian": "x, graph", "gauss_newton_step": "x, graph"}.items()
)
STEPS = {
    "the remarks": (describe, "remarks"),
    "the group": (describe, "digest"),
    "the name": (describe.Describer, "_named"),
    "the case": (describe, "_case"),
    "the facts": (explain, "_facts"),
    "the probes": (explain, "_probed"),
    "the gallery": (explain, "_shown"),
    "the words of a stage": (type(stage("residual")), "explain"),
    "all that is said without asking": (describe.Describer, "describe"),
    "all that is asked again": (worker, "explain"),
    "the taking of words": (worker, "only_words"),
}


@pytest.fixture(scope="module")
def graded(plan):
    """A function that grades a text as a worker does."""
    points = {**plan.points, "answers": 5.0, "written": 5.0}
    whole = replace(plan, points=points)
    with Sandbox(plan.inputs, Limits(cpu_seconds=1.0)) as sandbox:
        examiner = Examiner(whole, sandbox)
        yield lambda text: examiner.do(Grade(Source(kind="module", cells=[text], name="slam1d.py")))


@pytest.fixture(scope="module")
def undisturbed(graded):
    """The same submission with every explanation."""
    return graded(WRONG)


def marks(answer):
    """Return everything that is a mark."""
    return [
        (each.name, each.status, each.score, each.max_score)
        + tuple((check.name, check.passed, check.points, check.max_points, check.cases) for check in each.checks)
        for each in answer.stages
    ]


def result_of(answer):
    """Write down an answer as a run does."""
    score = sum(each.score for each in answer.stages)
    facts = {"confinement": "full", "seed": 0, "grader_version": "0", "fingerprint": "", "seconds": 0.0}
    return Result(
        submission="ada",
        status="graded",
        score=score,
        max_score=95.0,
        stages=answer.stages,
        flags=answer.flags,
        **facts,
    )


@pytest.mark.parametrize("error", [TypeError("len() of unsized object"), MemoryError(), RecursionError("too deep")])
@pytest.mark.parametrize("step", STEPS)
def test_whatever_an_explanation_raises_the_marks_stand(graded, undisturbed, monkeypatch, step, error):
    """The marks are those of a run that explains everything; the page has a plain sentence, and staff a flag."""

    def broken(*_, **__):
        raise error

    monkeypatch.delenv(STRICT)
    monkeypatch.setattr(*STEPS[step], broken)
    answer = graded(WRONG)
    assert isinstance(answer, Graded)
    assert marks(answer) == marks(undisturbed)
    assert undisturbed.flags == ()
    assert answer.flags
    assert all("The marks stand" in flag and type(error).__name__ in flag for flag in answer.flags)
    residual = next(each for each in answer.stages if each.name == "residual")
    assert "residual" in residual.message or "row" in residual.message
    result = result_of(answer)
    assert "For a human to look at" in class_page([result], {})
    assert answer.flags[0].split(" (")[0] in class_page([result], {})
    assert "The marks stand" not in feedback_page(result)


def test_the_plain_sentence_says_what_came_and_what_was_expected(graded, monkeypatch):
    """Where no explanation works at all, a page still shows a number that came beside the one that was expected."""

    def broken(*_, **__):
        raise TypeError

    monkeypatch.delenv(STRICT)
    monkeypatch.setattr(describe.Describer, "describe", broken)
    monkeypatch.setattr(worker, "explain", broken)
    text = REFERENCE + "\n\ndef residual(x, graph):\n    return np.full(graph.n_factors, 7.0)\n"
    residual = next(each for each in graded(text).stages if each.name == "residual")
    assert residual.message.startswith("residual returned [")
    assert " = 7, expected " in residual.message
    text = REFERENCE + "\n\ndef residual(x, graph):\n    return 7.0\n"
    residual = next(each for each in graded(text).stages if each.name == "residual")
    assert residual.message == "residual returned shape (), expected (6,)."


def test_a_failed_explanation_fails_our_tests(graded, monkeypatch):
    """Under our tests the same failure is a fault of the grader."""

    def broken(*_, **__):
        raise TypeError("no words")

    monkeypatch.setattr(explain, "_facts", broken)
    assert graded(WRONG) == Trouble("The grader failed (TypeError: no words).")


def test_words_cannot_change_marks(undisturbed):
    """What is taken from an explanation are words; points, statuses and numbers of cases stay."""
    first = undisturbed.stages[0]
    dearer = [replace_score(each) for each in undisturbed.stages]
    taken = only_words(undisturbed.stages, dearer)
    assert [each.message for each in taken] == ["other"] * len(taken)
    assert [(each.score, each.status) for each in taken] == [(each.score, each.status) for each in undisturbed.stages]
    assert taken[0].checks == first.checks
    assert np.isfinite(taken[0].score)


def replace_score(verdict):
    """Return a verdict with full marks and another message."""
    return type(verdict)(
        name=verdict.name, status="passed", score=99.0, max_score=99.0, message="other", checks=verdict.checks
    )
