"""How much students are shown, and what a page says of the rest."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

import pytest

from autograder.course import Course
from autograder.exports.words import feedback_text
from autograder.marking.showing import shown_at
from autograder.reports.feedback import feedback_page
from tests.reports.examples import small_class

DUE = datetime(2026, 11, 20, 22, 59, tzinfo=UTC)


def test_students_are_shown_less_until_nobody_can_hand_in() -> None:
    """The last extension and the late days count."""
    course = Course(before_due="score", due=DUE, late_days=2, extensions={"ann": DUE + timedelta(days=7)})
    assert shown_at(course, DUE).policy == "score"
    assert shown_at(course, DUE + timedelta(days=8)).policy == "score"
    assert shown_at(course, DUE + timedelta(days=9, minutes=1)).policy == "full"
    assert shown_at(Course(before_due="hint"), DUE).policy == "full"


def test_a_page_says_that_more_follows_and_when() -> None:
    """In the zone of the course, on the page and in the text."""
    shown = shown_at(Course(before_due="hint", due=DUE, late_days=2, zone="Europe/Berlin"), DUE)
    when = "After Sunday, 22 November 2026, 23:59 (Europe/Berlin, UTC+01:00), when nobody can hand in any more"
    assert shown.later.startswith(when)
    assert "the smallest case that shows each mistake" in shown.later
    one = small_class()[0]
    assert when in feedback_page(one, shown.policy, "SLAM", shown.later)
    assert when in " ".join(feedback_text(one, shown.policy, "SLAM", shown.later).split())


@pytest.mark.parametrize(
    ("course", "now", "asked"),
    [
        (Course(before_due="hint", due=DUE), DUE, None),
        (Course(before_due="hint", due=DUE), DUE - timedelta(days=1), "score"),
        (Course(before_due="full", feedback="hint", due=DUE), DUE - timedelta(days=1), None),
        (Course(before_due="hint"), DUE, None),
        (Course(due=DUE), DUE - timedelta(days=1), None),
    ],
)
def test_nothing_is_promised_where_nothing_follows(course: Course, now: datetime, asked: None) -> None:
    """After the last moment, where staff asked for less, where less follows, and where nothing is due."""
    assert shown_at(course, now, asked).later == ""
