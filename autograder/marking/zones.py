"""Time zones as they are abbreviated beside a time: one meaning, the meaning in the course's zone, or none."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import UTC, datetime, timedelta, timezone, tzinfo
from zoneinfo import ZoneInfo

# Hours from UTC. An abbreviation with several is in use for several zones: the zone of the course decides, or nobody.
OFFSETS: Mapping[str, tuple[float, ...]] = {
    "Z": (0,), "UT": (0,), "UTC": (0,), "GMT": (0,), "WET": (0,), "WEST": (1,), "BST": (1, 6, 11),
    "CET": (1,), "CEST": (2,), "MET": (1,), "MEST": (2,), "MEZ": (1,), "MESZ": (2,), "EET": (2,), "EEST": (3,),
    "MSK": (3,), "SAST": (2,), "WAT": (1,), "CAT": (2,), "EAT": (3,), "PKT": (5,), "IST": (1, 2, 5.5), "IDT": (3,),
    "NST": (-3.5,), "NDT": (-2.5,), "AST": (-4, 3), "ADT": (-3, 4), "EST": (-5,), "EDT": (-4,),
    "CST": (-6, -5, 8), "CDT": (-5, -4), "MST": (-7, 8), "MDT": (-6,), "PST": (-8,), "PDT": (-7,), "AKST": (-9,),
    "AKDT": (-8,), "HST": (-10,), "BRT": (-3,), "SGT": (8,), "HKT": (8,), "WIB": (7,), "JST": (9,), "KST": (9,),
    "AWST": (8,), "ACST": (9.5,), "ACDT": (10.5,), "AEST": (10,), "AEDT": (11,), "NZST": (12,), "NZDT": (13,),
}  # fmt: skip


def zone_of(name: str) -> ZoneInfo | None:
    """Return the zone of a name such as "Europe/Berlin"; None where there is none."""
    try:
        return ZoneInfo(name)
    except (LookupError, OSError, ValueError):
        return None


def meant(name: str, wall: datetime, course: tzinfo | None) -> tzinfo | None:
    """Return what an abbreviation or the name of a zone stands for beside a time; None where that cannot be told.

    Parameters
    ----------
    name : str
        As it stands beside the time.
    wall : datetime
        The time, without a zone.
    course : tzinfo, optional
        The zone of the course.

    Examples
    --------
    >>> noon = datetime(2026, 7, 1, 12)
    >>> print(meant("CEST", noon, None), meant("IST", noon, None), meant("IST", noon, ZoneInfo("Asia/Kolkata")))
    UTC+02:00 None UTC+05:30
    """
    offsets = OFFSETS.get(name.upper())
    if offsets is None:
        return zone_of(name) if "/" in name else None
    fitting = _in_zone(name.upper(), wall, course)
    if fitting is None and len(offsets) == 1:
        fitting = timedelta(hours=offsets[0])
    if fitting is None and course is not None:
        here = wall.replace(tzinfo=course).utcoffset()
        fitting = next((each for each in map(_hours, offsets) if each == here), None)
    return None if fitting is None else UTC if not fitting else timezone(fitting)


def _hours(value: float) -> timedelta:
    return timedelta(hours=value)


def _in_zone(name: str, wall: datetime, course: tzinfo | None) -> timedelta | None:
    """Return the offset that goes by this abbreviation in the zone of the course, at this time or half a year off."""
    if course is None:
        return None
    for days in (0, 182, -182):
        try:
            there = (wall + timedelta(days=days)).replace(tzinfo=course)
        except OverflowError:
            continue
        if there.tzname() == name:
            return there.utcoffset()
    return None
