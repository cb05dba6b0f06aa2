"""Moments in words, for readers: with the day of the week, and the zone in which they are told."""

from __future__ import annotations

from datetime import datetime, timedelta
from zoneinfo import ZoneInfo

# Not strftime's names: those are the machine's language.
_DAYS = ("Monday", "Tuesday", "Wednesday", "Thursday", "Friday", "Saturday", "Sunday")
_MONTHS = (
    *("January", "February", "March", "April", "May", "June"),
    *("July", "August", "September", "October", "November", "December"),
)


def clock(when: datetime, zone: str = "") -> str:
    """Write a moment for readers, in a zone that is named or in its own.

    Examples
    --------
    >>> clock(datetime.fromisoformat("2026-11-20T22:59:00+00:00"), "Europe/Berlin")
    'Friday, 20 November 2026, 23:59 (Europe/Berlin, UTC+01:00)'
    >>> clock(datetime.fromisoformat("2026-11-20T22:59:00+00:00"))
    'Friday, 20 November 2026, 22:59 (UTC)'
    """
    there = when.astimezone(ZoneInfo(zone)) if zone else when
    offset = there.utcoffset() or timedelta(0)
    sign, minutes = "-" if offset < timedelta(0) else "+", abs(offset) // timedelta(minutes=1)
    utc = f"UTC{sign}{minutes // 60:02}:{minutes % 60:02}" if minutes else "UTC"
    date = f"{_DAYS[there.weekday()]}, {there.day} {_MONTHS[there.month - 1]} {there.year}"
    return f"{date}, {there:%H:%M} ({f'{zone}, ' if zone else ''}{utc})"
