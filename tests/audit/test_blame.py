"""A wrong verdict is tried again until something is to blame: a setting, the machine, or the grader itself."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import pytest

from autograder.audit.blame import GRADER, MACHINE, MOST, SETTING, blame, differing
from autograder.audit.cases import Case
from autograder.audit.expectation import Cell, Expected
from autograder.audit.words import meaning
from autograder.course import Course
from autograder.sandbox.frames import Source

Outcome = Callable[[Course], str]


def case(name: str) -> Case:
    """Make a case of this name."""
    return Case("wrong", name, Source("module", [""], name), Expected())


def judge(outcomes: dict[str, Outcome]) -> Callable[[Sequence[Case], Course, int], list[str]]:
    """Judge each case by its own rule."""
    return lambda cases, course, _workers: [outcomes[one.name](course) for one in cases]


def test_what_is_right_alone_is_the_machines() -> None:
    """It was wrong among others only."""
    found = blame([case("a")], Course(seed=0), judge({"a": lambda _: ""}))
    assert found["a"].what == MACHINE


@pytest.mark.parametrize("status", ["timeout", "memory"])
def test_what_ends_at_a_limit_alone_and_with_defaults_is_the_machines(status: str) -> None:
    """The defaults are enough on other machines."""
    found = blame([case("a")], Course(seed=0, time_limit=1.0), judge({"a": lambda _: status}))
    assert found["a"].what == MACHINE
    assert "raise [limits] time or memory" in found["a"].why


def test_the_setting_is_named_that_alone_makes_it_wrong() -> None:
    """Each case its own; what is wrong with all defaults is no setting's."""
    course = Course(seed=3, examples=2, time_limit=0.1)
    outcomes: dict[str, Outcome] = {
        "few": lambda course: "caught" if course.examples < 10 else "",
        "short": lambda course: "timeout" if course.time_limit < 1 else "",
        "both": lambda course: "caught" if course.examples < 10 and course.time_limit < 1 else "",
        "ours": lambda _: "caught",
    }
    found = blame([case(name) for name in outcomes], course, judge(outcomes))
    assert {name: one.what for name, one in found.items()} == {
        "few": SETTING,
        "short": SETTING,
        "both": SETTING,
        "ours": GRADER,
    }
    assert "[grading] examples = 2 (default 200)." in found["few"].why
    assert "[limits] time = 0.1 (default 2)." in found["short"].why
    assert "only together" in found["both"].why


def test_no_more_than_a_few_are_tried() -> None:
    """An exam that is spoilt as a whole does not cost a second audit."""
    tried: list[int] = []

    def wrong(cases: Sequence[Case], _course: Course, _workers: int) -> list[str]:
        tried.append(len(cases))
        return ["failed" for _ in cases]

    found = blame([case(str(k)) for k in range(100)], Course(seed=0), wrong)
    assert (len(found), max(tried)) == (MOST, MOST)


def test_the_defaults_differ_in_nothing() -> None:
    """Points that were changed are named by their stage."""
    assert differing(Course(seed=0)) == {}
    assert set(differing(Course(seed=0, points={**Course().points, "residual": 0.0}))) == {"points"}


@pytest.mark.parametrize(
    ("expected", "got", "words"),
    [
        ("caught:loop_sign", "caught", "caught, not named as itself"),
        ("caught:loop_sign", "caught:prior_sign", "caught, named prior_sign instead of loop_sign"),
        ("failed", "failed:loop_sign", "failed, named loop_sign, where no name fits"),
        ("caught:loop_sign", "timeout", "the outcome is timeout, not caught"),
        ("caught:loop_sign", "passed", "a wrong answer passes"),
        ("kept", "failed", "a mistake elsewhere costs points here"),
        ("partial+follow_through", "partial", "the follow-through share is not paid"),
        ("passed", "passed", ""),
    ],
)
def test_a_cell_is_explained(expected: str, got: str, words: str) -> None:
    """In words that need no table of the code."""
    assert meaning(Cell("jacobian", expected, got)) == words
