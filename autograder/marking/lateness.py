"""How late a submission is, by its own time, and what that costs by the rule of the course."""

from __future__ import annotations

import math
import re
from datetime import UTC, datetime, timedelta, timezone, tzinfo
from zoneinfo import ZoneInfo

from autograder.course import Course, Feedback
from autograder.verdicts import Result

_DAY = 86_400.0
_TIME = re.compile(
    r"(?P<date>\d{4}-\d\d-\d\d)[T ](?P<time>\d\d:\d\d(?::\d\d)?)(?:\.\d+)? ?(?P<zone>[+-]\d\d:?\d\d|[A-Za-z][\w/+-]*)?"
)


def moment(text: str, default: tzinfo | None = None) -> datetime | None:
    """Read the time of a submission as the learning platforms write it; None where it is none.

    Examples
    --------
    >>> print(moment("2026-01-02 03:04:05 Z"), moment("2026-01-02 03:04:05.678 -0730"))
    2026-01-02 03:04:05+00:00 2026-01-02 03:04:05-07:30
    >>> moment("yesterday") is None, moment("2026-01-02 03:04:05") is None
    (True, True)
    """
    found = _TIME.fullmatch(text.strip())
    if found is None:
        return None
    zone = _zone(found["zone"]) if found["zone"] else default
    try:
        return None if zone is None else datetime.fromisoformat(f"{found['date']} {found['time']}").replace(tzinfo=zone)
    except ValueError:
        return None


def _zone(name: str) -> tzinfo | None:
    if name in ("Z", "UTC", "GMT"):
        return UTC
    if name[0] in "+-":
        minutes = int(name[1:3]) * 60 + int(name[-2:])
        return timezone((1 if name[0] == "+" else -1) * timedelta(minutes=minutes)) if minutes < 1440 else None
    try:
        return ZoneInfo(name)
    except (LookupError, OSError, ValueError):
        return None


def due_for(result: Result, course: Course) -> datetime | None:
    """Return the due date of one student: the extension by the submission's name or the student's id, else the due."""
    for name in (result.submission, result.student_id or ""):
        if name in course.extensions:
            return course.extensions[name]
    return course.due


def days_late(result: Result, course: Course) -> int:
    """Count the days that have begun between due date (with grace) and submission; 0 where it is in time or unknown."""
    due = due_for(result, course)
    if due is None:
        return 0
    handed_in = moment(result.submitted, due.tzinfo)
    if handed_in is None:
        return 0
    late = (handed_in - due).total_seconds() - 60 * course.grace_minutes
    return math.ceil(late / _DAY) if late > 0 else 0


def penalised(score: float, days: int, course: Course, maximum: float) -> tuple[float, str]:
    """Return the score after the late rule, and the rule in words; "" where it costs nothing.

    Examples
    --------
    >>> penalised(80.0, 2, Course(late_per_day=10.0), 100.0)
    (60.0, 'handed in 2 days late: 10 % of 100 points for each begun day')
    """
    told = f"handed in {days} day{'' if days == 1 else 's'} late"
    if course.late_days is not None and days > course.late_days:
        return 0.0, f"{told}: nothing is taken after {course.late_days} day{'' if course.late_days == 1 else 's'}"
    if days <= 0 or course.late_per_day <= 0:
        return score, ""
    after = max(0.0, score - days * course.late_per_day / 100 * maximum)
    return round(after, 6), f"{told}: {course.late_per_day:g} % of {maximum:g} points for each begun day"


def policy_at(course: Course, now: datetime) -> Feedback:
    """Return how much students are shown at a time: less as long as somebody may still hand in."""
    if course.before_due is None or course.due is None:
        return course.feedback
    last = max([course.due, *course.extensions.values()]) + timedelta(
        days=course.late_days or 0, minutes=course.grace_minutes
    )
    return course.before_due if now < last else course.feedback
