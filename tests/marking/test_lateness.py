"""When something was handed in: read, or flagged, and never a silent default."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime, timedelta
from zoneinfo import ZoneInfo

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.course import Course
from autograder.marking.lateness import days_late, moment
from autograder.marking.merging import merged
from tests.marking.written import answered

DUE = datetime(2026, 11, 20, 22, 59, tzinfo=UTC)
COURSE = Course(due=DUE, late_per_day=10.0)


@pytest.mark.parametrize(
    ("text", "hours"),
    [
        ("2026-11-22 12:00:00.123456 CEST", 10),
        ("2026-11-22 12:00:00.123456 CET", 11),
        ("2026-11-22 12:00:00.123456 EDT", 16),
        ("2026-11-22 12:00:00.123456 EST", 17),
        ("2026-11-22 12:00:00.123456 PST", 20),
        ("2026-11-22 12:00:00.123456 UTC", 12),
        ("2026-11-22 12:00:00 +01", 11),
        ("2026-11-22 12:00:00 +0530", 6.5),
        ("2026-11-22T12:00:00Z", 12),
        ("2026-11-22 12:00 UTC+2", 10),
        ("11/22/2026 12:00 PM PST", 20),
        ("22/11/2026, 12:00 Europe/Berlin", 11),
    ],
)
def test_a_time_is_read_as_the_platforms_write_it(text: str, hours: float) -> None:
    """The hour of Greenwich is told for each by hand; all of them are two days late."""
    assert moment(text, UTC) == datetime(2026, 11, 22, tzinfo=UTC) + timedelta(hours=hours)
    assert days_late(msgspec.structs.replace(answered("ann"), submitted=text), COURSE) == 2


@pytest.mark.parametrize(
    "text",
    ["2026-11-22 12:00 IST", "2026-11-22 12:00 XYZT", "11/12/2026 12:00 UTC", "next Friday", "2026-13-40 9:00 Z"],
)
def test_a_time_that_cannot_be_told_is_flagged(text: str) -> None:
    """No penalty is taken, and staff see why."""
    (found,) = merged([msgspec.structs.replace(answered("ann"), submitted=text)], course=COURSE)
    assert not found.adjustments
    assert any(text in flag and "cannot be told" in flag for flag in found.flags)


@pytest.mark.parametrize(
    ("zone", "text", "hours"),
    [
        ("Asia/Kolkata", "2026-11-22 12:00 IST", 6.5),
        ("Asia/Jerusalem", "2026-11-22 12:00 IST", 10),
        ("Europe/Dublin", "2026-11-22 12:00 IST", 11),
        ("America/Chicago", "2026-11-22 12:00 CST", 18),
        ("Asia/Shanghai", "2026-11-22 12:00 CST", 4),
        ("Europe/London", "2026-11-22 12:00 BST", 11),
        ("America/New_York", "11/12/2026 12:00 PM", 17 - 240),
    ],
)
def test_the_zone_of_the_course_decides_between_meanings(zone: str, text: str, hours: float) -> None:
    """Three countries write IST, and mean three hours."""
    assert moment(text, ZoneInfo(zone)) == datetime(2026, 11, 22, tzinfo=UTC) + timedelta(hours=hours)


@given(
    st.sampled_from(["Europe/Berlin", "America/New_York", "Australia/Sydney", "Asia/Kolkata", "America/St_Johns"]),
    st.integers(0, 700),
    st.integers(0, 9),
    st.integers(1, 1320),
)
def test_the_same_evening_hour_costs_the_same_all_year(zone: str, start: int, days: int, minutes: int) -> None:
    """A day ends at the hour of the due date on the course's clock, whatever happened to the clock meanwhile."""
    there = ZoneInfo(zone)
    due = datetime(2026, 1, 1, 20, tzinfo=there) + timedelta(days=start)  # moves the day on the wall
    handed_in = due + timedelta(days=days)
    course = Course(due=datetime.fromisoformat(due.isoformat()), zone=zone)
    for when, expected in (
        (handed_in, days),
        (handed_in.astimezone(UTC) + timedelta(minutes=minutes), days + 1),
    ):
        assert (
            days_late(msgspec.structs.replace(answered("ann"), submitted=when.isoformat(sep=" ")), course) == expected
        )


def test_the_change_of_the_clock_is_one_day_also_where_only_the_time_names_its_zone() -> None:
    """Half past seven on the evening after is within a day of eight o'clock, though more than 24 hours went by."""
    course = Course(due=datetime.fromisoformat("2026-10-24T20:00:00+02:00"), late_per_day=10.0)
    late = msgspec.structs.replace(answered("ann"), submitted="2026-10-25 19:30:00 Europe/Berlin")
    assert days_late(late, course) == 1
    assert days_late(msgspec.structs.replace(late, submitted="2026-10-25 20:01:00 Europe/Berlin"), course) == 2
    assert days_late(late, replace(course, zone="Europe/Berlin")) == 1


def test_an_extension_is_found_whether_accents_are_composed_or_not() -> None:
    """One keyboard writes an e with an accent, another an e and an accent."""
    course = replace(COURSE, extensions={"Zoe\u0301": DUE + timedelta(days=9)})
    late = msgspec.structs.replace(answered("ann"), student_id="Zo\u00e9", submitted="2026-11-22 12:00 UTC")
    assert days_late(late, course) == 0
