"""How late a submission is, by its own time, and what that costs by the rule of the course."""

from __future__ import annotations

import re
from collections.abc import Mapping
from datetime import UTC, datetime, timedelta, timezone, tzinfo
from zoneinfo import ZoneInfo

from autograder.course import Course
from autograder.marking.spreadsheets import plain
from autograder.marking.zones import meant, zone_of
from autograder.verdicts import Result

_CLOCK = r"(?P<hour>\d{1,2}):(?P<minute>\d\d)(?::(?P<second>\d\d)(?:\.\d+)?)?(?: ?(?P<half>[AaPp])\.?[Mm]\.?)?"
_OFFSET = r"(?:UTC|GMT)?(?P<sign>[+-])(?P<hours>\d\d?)(?::?(?P<minutes>\d\d))?"
_ZONE = rf"(?: ?(?:{_OFFSET}|(?P<zone>[A-Za-z][\w/+-]*)))?"
_ISO = re.compile(rf"(?P<year>\d{{4}})-(?P<month>\d\d?)-(?P<day>\d\d?)(?:[T ]|, ){_CLOCK}{_ZONE}")
_SLASHED = re.compile(rf"(?P<one>\d\d?)/(?P<two>\d\d?)/(?P<year>\d{{4}})(?: |, ){_CLOCK}{_ZONE}")


def moment(text: str, zone: tzinfo | None = None) -> datetime | None:
    """Read the time of a submission as the learning platforms write it; None where it cannot be told.

    Parameters
    ----------
    text : str
        A date as year-month-day, or with slashes where only one order of day and month makes a date;
        a time; an offset, an abbreviation or the name of a zone.
    zone : tzinfo, optional
        That of the course: of a time without one, and of an abbreviation with several meanings.

    Examples
    --------
    >>> print(moment("2026-01-02 03:04:05 Z"), moment("2026-01-02 03:04:05.678 -0730"))
    2026-01-02 03:04:05+00:00 2026-01-02 03:04:05-07:30
    >>> print(moment("11/22/2026 1:05 PM PST"), moment("2026-11-22 12:00 +01"))
    2026-11-22 13:05:00-08:00 2026-11-22 12:00:00+01:00
    >>> moment("yesterday"), moment("2026-01-02 03:04:05"), moment("03/04/2026 12:00 UTC")
    (None, None, None)
    """
    text = " ".join(text.split())
    found = _ISO.fullmatch(text) or _SLASHED.fullmatch(text)
    if found is None:
        return None
    part = found.groupdict()
    try:
        wall = _wall(part, zone)
        there = zone if wall is None or not (part["sign"] or part["zone"]) else _zone(part, wall, zone)
    except (ValueError, OverflowError):
        return None
    return None if wall is None or there is None else wall.replace(tzinfo=there)


def _wall(part: Mapping[str, str | None], zone: tzinfo | None) -> datetime | None:
    """Return the time without its zone; None where day and month cannot be told apart."""
    number = {name: int(value) for name, value in part.items() if value and value.isdecimal()}
    if "one" in number:
        one, two = number["one"], number["two"]
        american = isinstance(zone, ZoneInfo) and zone.key.startswith(("America/", "US/"))
        if max(one, two) <= 12 and one != two and not american:
            return None
        number["month"], number["day"] = (two, one) if one > 12 else (one, two)
    hour = number["hour"]
    if half := part["half"]:
        if not 1 <= hour <= 12:
            return None
        hour = hour % 12 + 12 * (half in "Pp")
    year, month, day = (number[name] for name in ("year", "month", "day"))
    return datetime(year, month, day, hour, number["minute"], number.get("second", 0), tzinfo=None)  # next


def _zone(part: Mapping[str, str | None], wall: datetime, course: tzinfo | None) -> tzinfo | None:
    if not part["sign"]:
        return meant(part["zone"] or "", wall, course)
    minutes = int(part["hours"] or 0) * 60 + int(part["minutes"] or 0)
    if not minutes:
        return UTC
    return timezone(timedelta(minutes=minutes if part["sign"] == "+" else -minutes)) if minutes < 1440 else None


def due_for(result: Result, course: Course) -> datetime | None:
    """Return the due date of one student: the extension by the submission's name or the student's id, else the due."""
    keys = {plain(name): name for name in course.extensions}
    for name in (result.submission, result.student_id or ""):
        if plain(name) in keys:
            return course.extensions[keys[plain(name)]]
    return course.due


def handed_in(result: Result, course: Course) -> datetime | None:
    """Return when a submission was handed in; None where that is not known."""
    due = due_for(result, course)
    return moment(result.submitted, zone_of(course.zone) or (None if due is None else due.tzinfo))


def days_late(result: Result, course: Course) -> int:
    """Count the days that have begun between due date (with grace) and submission; 0 where it is in time or unknown.

    A day ends at the hour of the due date, also where the clock was changed in between: in the zone of the course,
    or in the one that the time itself names where it fits the due date.
    """
    due, when = due_for(result, course), handed_in(result, course)
    if due is None or when is None:
        return 0
    zone = zone_of(course.zone) or _fitting(when.tzinfo, due) or due.tzinfo
    wall, grace = due.astimezone(zone), timedelta(minutes=course.grace_minutes)
    if when <= due + grace:
        return 0
    days = max(0, int((when - due).total_seconds() // 86_400) - 1)
    while (wall + timedelta(days=days)).astimezone(UTC) + grace < when:  # the addition moves the wall clock's day
        days += 1
    return days


def _fitting(zone: tzinfo | None, due: datetime) -> tzinfo | None:
    """Return a zone with a name where the due date may have been written in it."""
    return zone if isinstance(zone, ZoneInfo) and due.astimezone(zone).utcoffset() == due.utcoffset() else None


def unknown_time(result: Result, course: Course) -> str:
    """Say to staff that nobody knows whether a submission is late; "" where that is known or does not matter."""
    if due_for(result, course) is None or handed_in(result, course) is not None:
        return ""
    if result.submitted:
        return f"When it was handed in cannot be told from {result.submitted[:60]!r}; no penalty was taken."
    return "The learning platform marks it late and gives no time; no penalty was taken." if result.late else ""


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
