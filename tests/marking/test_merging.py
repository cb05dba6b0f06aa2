"""What every report shows: verdicts, then the course's points, marks, overrides and the late rule, in this order."""

from __future__ import annotations

from datetime import UTC, datetime

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.course import DEFAULT_POINTS, Course
from autograder.errors import UsageError
from autograder.marking.marks import Mark, digest
from autograder.marking.merging import merged
from autograder.marking.overrides import Override
from autograder.verdicts import CheckVerdict, Result, StageVerdict
from tests.marking.written import TEXTS, answered, written_class

DUE = datetime(2026, 11, 20, 23, 59, tzinfo=UTC)


def marks(name: str, **points: float) -> dict[tuple[str, str], Mark]:
    """Marks for the answers of one student: q2=1.5."""
    maxima = {"2": 2.0, "3": 3.0}
    found = {}
    for question, value in points.items():
        key = (name, question[1:])
        found[key] = Mark(*key, value, maxima[key[1]], f"comment {key[1]}", digest(TEXTS[key[1]]))
    return found


def one(result: Result, **given: object) -> Result:
    """Merge one result."""
    [found] = merged([result], **given)  # type: ignore[arg-type] - names are those of merged
    return found


def test_without_decisions_nothing_changes_but_words() -> None:
    """Scores, maxima, awaiting points and stages stay what the machine said."""
    for before, after in zip(written_class(), merged(written_class()), strict=True):
        assert (after.score, after.max_score, after.awaiting) == (before.score, before.max_score, before.awaiting)
        assert [s.status for s in after.stages] == [s.status for s in before.stages]


def test_marks_fill_the_stage() -> None:
    """Both questions marked: no longer provisional; comments are for the student."""
    found = one(answered("ann"), marks=marks("ann", q2=1.5, q3=3))
    assert (found.score, found.provisional, found.awaiting) == (99.5, False, 0.0)
    assert found.stages[-1].status == "partial"
    assert found.comments == {"2": "comment 2", "3": "comment 3"}
    assert one(answered("ann"), marks=marks("ann", q2=2, q3=3)).stages[-1].status == "passed"
    assert one(answered("ann"), marks=marks("ann", q2=0, q3=0)).stages[-1].status == "failed"


def test_half_marked_is_still_provisional() -> None:
    """Of 97 once the two points of question 2 are given."""
    found = one(answered("ann"), marks=marks("ann", q2=1))
    assert (found.score, found.max_score - found.awaiting, found.stages[-1].status) == (96.0, 97.0, "awaiting_mark")


def test_an_answer_that_is_not_there_needs_no_mark() -> None:
    """Question 2 is empty; with question 3 marked nothing waits."""
    found = one(answered("bob", {"3": TEXTS["3"]}), marks=marks("bob", q3=3))
    assert (found.score, found.awaiting, found.stages[-1].status) == (98.0, 0.0, "partial")


def test_a_mark_of_other_words_does_not_count() -> None:
    """Who hands in another answer is read again; blanks do not make another answer."""
    other = answered("ann", {**TEXTS, "3": "something else"})
    found = one(other, marks=marks("ann", q2=2, q3=3))
    assert (found.score, found.awaiting) == (97.0, 3.0)
    assert "has changed" in found.stages[-1].message
    assert one(answered("ann", {**TEXTS, "3": " f is\naffine. "}), marks=marks("ann", q2=2, q3=3)).awaiting == 0


def test_other_points_of_a_stage_move_its_checks_and_the_total() -> None:
    """Which checks passed stays; follow-through stays its share."""
    checks = (
        CheckVerdict(name="a", passed=True, points=8.0, max_points=8.0, cases=1),
        CheckVerdict(name="b", passed=False, points=6.0, max_points=12.0, cases=1),
    )
    stage = StageVerdict(name="gauss_newton_step", status="partial", score=14.0, max_score=20.0, checks=checks)
    ann = answered("ann")
    ann = msgspec.structs.replace(
        ann, stages=tuple(stage if s.name == stage.name else s for s in ann.stages), score=89.0
    )
    assert one(ann, course=Course(follow_through=0.5)).score == 89.0
    course = Course(points={**DEFAULT_POINTS, "gauss_newton_step": 10.0}, follow_through=0.25)
    found = one(ann, course=course)
    new = next(s for s in found.stages if s.name == stage.name)
    assert [(c.points, c.max_points) for c in new.checks] == [(4.0, 4.0), (1.5, 6.0)]
    assert (new.score, found.score, found.max_score) == (5.5, 80.5, 90.0)


def test_marks_scale_with_their_stage() -> None:
    """A mark of 1.5 of 2 is 3 of 4 where the stage has 10 points."""
    course = Course(points={**DEFAULT_POINTS, "written": 10.0})
    assert one(answered("ann"), marks=marks("ann", q2=1.5, q3=3), course=course).stages[-1].score == 9.0


def test_a_stage_that_had_no_points_cannot_get_some() -> None:
    """Its checks have no shares; the message says to grade again."""
    ann = answered("ann")
    empty = tuple(
        msgspec.structs.replace(s, score=0.0, max_score=0.0) if s.name == "residual" else s for s in ann.stages
    )
    with pytest.raises(UsageError, match="grade again"):
        merged([msgspec.structs.replace(ann, stages=empty)])


def test_an_override_of_a_stage_and_of_the_total() -> None:
    """The stage is replaced, the rest stays; the total is the last word; both are told."""
    stage = Override(2, "ann", "residual", 12.0, "copied", "Prof", "today")
    found = one(answered("ann"), overrides=[stage])
    assert (found.score, found.stages[0].score, found.stages[0].status) == (92.0, 12.0, "partial")
    assert [a.said for a in found.adjustments] == ["residual set to 12, was 15: copied (Prof, today)"]
    total = Override(3, "ann", "total", 70.0, "appeal", "Prof", "today")
    found = one(answered("ann"), overrides=[stage, total])
    assert (found.score, found.provisional) == (70.0, False)
    assert len(found.adjustments) == 2


def test_an_override_finds_a_student_by_id_and_a_fault_of_ours_gets_a_score() -> None:
    """Who could not be graded can be marked by hand."""
    kim = answered("kim", student_id="1017")
    broken = msgspec.structs.replace(kim, status="grader_error", score=None, stages=(), written={})
    assert one(broken, overrides=[Override(2, "1017", "total", 80.0, "by hand", "Prof", "today")]).score == 80.0


@pytest.mark.parametrize(
    ("submitted", "score"),
    [
        ("2026-11-20 23:59:00 Z", 95.0),
        ("2026-11-21 00:29:00 Z", 95.0),  # grace
        ("2026-11-21 00:29:01 Z", 85.0),
        ("2026-11-20 18:00:00 -0800", 85.0),
        ("2026-11-22 00:30:00 Z", 75.0),
        ("2026-11-23 12:00:00 Z", 65.0),
        ("2026-11-24 12:00:00 Z", 0.0),
        ("", 95.0),
        ("last night", 95.0),
    ],
)
def test_the_late_rule_goes_by_the_submissions_own_time(submitted: str, score: float) -> None:
    """Ten per cent of the maximum for each begun day after half an hour of grace, nothing after three days."""
    course = Course(due=DUE, late_per_day=10.0, grace_minutes=30.0, late_days=3)
    found = one(answered("ann", submitted=submitted), course=course)
    assert found.score == score
    assert bool(found.adjustments) == (score != 95.0)


def test_an_extension_moves_the_due_date_of_one() -> None:
    """By name or by student id."""
    later = datetime(2026, 11, 27, tzinfo=UTC)
    late = "2026-11-25 12:00:00 Z"
    course = Course(due=DUE, late_per_day=10.0, extensions={"ann": later, "17": later})
    names = [
        answered("ann", submitted=late),
        answered("bob", submitted=late),
        answered("c", submitted=late, student_id="17"),
    ]
    assert [found.score for found in merged(names, course=course)] == [95.0, 45.0, 95.0]


def test_a_late_flag_without_a_time_is_for_staff() -> None:
    """No penalty is made up."""
    found = one(answered("ann", late=True), course=Course(due=DUE, late_per_day=10.0))
    assert found.score == 95.0
    assert "gives no time" in found.flags[0]


@given(points=st.floats(0, 20), late=st.integers(0, 5), q2=st.sampled_from([None, 0.0, 0.5, 2.0]), total=st.booleans())
def test_whatever_is_decided_the_total_stays_within_bounds(
    points: float, late: int, q2: float | None, total: bool
) -> None:
    """From 0 to the cap, and merging twice from the same results is the same."""
    course = Course(due=DUE, late_per_day=40.0)
    handed_in = answered("ann", submitted=f"2026-11-{20 + late} 23:58:00 Z")
    overrides = [Override(2, "ann", "total" if total else "jacobian", min(points, 15.0), "r", "w", "d")]
    given = {"marks": {} if q2 is None else marks("ann", q2=q2), "overrides": overrides, "course": course}
    found = one(handed_in, **given)
    assert found.score is not None
    assert 0 <= found.score <= 110
    assert one(handed_in, **given) == found
