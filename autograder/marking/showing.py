"""How much students are shown at a time, and, as long as that is less, when there is more."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime, timedelta

from autograder.course import Course, Feedback
from autograder.marking.clock import clock

_MORE = {
    ("score", "hint"): "the result of every stage, hints, and comments",
    ("score", "full"): "the result of every stage, hints, comments, and the smallest case that shows each mistake",
    ("hint", "full"): "the reasons, and the smallest case that shows each mistake",
}


@dataclass(frozen=True)
class Shown:
    """What a page shows.

    Parameters
    ----------
    policy : {"full", "hint", "score"}
        How much it shows.
    later : str
        A sentence for the student: what follows, and when; "" where this is all.
    """

    policy: Feedback
    later: str = ""


def shown_at(course: Course, now: datetime, asked: Feedback | None = None) -> Shown:
    """Return how much students are shown at a time: less as long as somebody may still hand in.

    Parameters
    ----------
    course : Course
        Its policies, before and after the due date.
    now : datetime
        The time.
    asked : {"full", "hint", "score"}, optional
        What staff asked for, whatever the course says.
    """
    last = last_moment(course)
    if asked is not None or last is None or course.before_due is None or now >= last:
        return Shown(asked or course.feedback)
    more = _MORE.get((course.before_due, course.feedback))
    when = clock(last, course.zone)
    said = f"After {when}, when nobody can hand in any more, your teachers can show more: {more}." if more else ""
    return Shown(course.before_due, said)


def last_moment(course: Course) -> datetime | None:
    """Return when the last of the class can hand in no more; None where nothing is due."""
    if course.due is None:
        return None
    after = timedelta(days=course.late_days or 0, minutes=course.grace_minutes)
    return max([course.due, *course.extensions.values()]) + after
