"""Every key of the course file: the field of `Course` that it sets, what it accepts, and that in words."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from difflib import get_close_matches
from typing import Any
from zoneinfo import ZoneInfo

from autograder.course.settings import DEFAULT_POINTS, QUESTION_POINTS, STAGES

Check = Callable[[Any], bool]


@dataclass(frozen=True)
class Setting:
    """One key of the course file."""

    field: str
    accepts: Check
    expected: str
    convert: Callable[[Any], Any] = lambda value: value


def _number(low: float, high: float, *, above: bool = False) -> Check:
    def accepts(value: Any) -> bool:
        real = isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
        return real and low <= value <= high and not (above and value == low)

    return accepts


def _whole(low: int, high: int) -> Check:
    return lambda value: isinstance(value, int) and not isinstance(value, bool) and low <= value <= high


def _one_of(*words: str) -> Check:
    return lambda value: value in words and isinstance(value, str)


def _is_stages(value: Any) -> bool:
    return (
        isinstance(value, list)
        and bool(value)
        and all(isinstance(name, str) and name in STAGES for name in value)
        and len(set(value)) == len(value)
    )


def _is_families(value: Any) -> bool:
    return (
        isinstance(value, list)
        and 0 < len(value) <= 100
        and all(isinstance(name, str) and 0 < len(name) <= 200 for name in value)
    )


def _is_moment(value: Any) -> bool:
    return isinstance(value, datetime) and value.tzinfo is not None


def _is_zone(value: Any) -> bool:
    try:
        return isinstance(value, str) and "/" in value and bool(ZoneInfo(value).key)
    except (LookupError, OSError, ValueError):
        return False


_POLICY = _one_of("full", "hint", "score")
_POLICIES = '"full", "hint" or "score"'
_MOMENT = "a date, a time and an offset from UTC without quotes, such as 2026-11-20T23:59:00+01:00"
# Sections whose keys are names that the course chooses: what each value is.
NAMED: dict[str, Setting] = {"extensions": Setting("extensions", _is_moment, _MOMENT)}
_POINTS = Setting("points", _number(0, 1000), "a number from 0 to 1000", float)
_QUESTION = Setting("question_points", _number(0, 1000), "a number from 0 to 1000", float)
KEYS: dict[str, dict[str, Setting]] = {
    "": {"title": Setting("title", lambda value: isinstance(value, str) and 0 < len(value) <= 200, "a short text")},
    "points": {**dict.fromkeys(DEFAULT_POINTS, _POINTS)},
    "grading": {
        "follow_through": Setting("follow_through", _number(0, 1), "a share from 0 to 1", float),
        "bonus_cap": Setting("bonus_cap", _number(0, 10_000), "a number from 0 to 10000", float),
        "examples": Setting("examples", _whole(1, 100_000), "a whole number from 1 to 100000"),
        "seed": Setting("seed", _whole(0, 2**63 - 1), "a whole number from 0 to 2^63 - 1"),
        "stages": Setting(
            "stages",
            _is_stages,
            f"a list of different stages out of {', '.join(STAGES)}",
            lambda value: tuple(stage for stage in STAGES if stage in value),
        ),
    },
    "limits": {
        "time": Setting("time_limit", _number(0, 600, above=True), "seconds, more than 0 and up to 600", float),
        "memory": Setting("memory_mib", _whole(64, 65_536), "whole MiB from 64 to 65536"),
        "output": Setting("output_mib", _whole(1, 1024), "whole MiB from 1 to 1024"),
    },
    "feedback": {
        "policy": Setting("feedback", _POLICY, _POLICIES),
        "before_due": Setting("before_due", _POLICY, _POLICIES),
    },
    "late": {
        "due": Setting("due", _is_moment, _MOMENT),
        "zone": Setting("zone", _is_zone, 'the name of a time zone, such as "Europe/Berlin"'),
        "grace_minutes": Setting("grace_minutes", _number(0, 10_000), "minutes from 0 to 10000", float),
        "per_day": Setting("late_per_day", _number(0, 100), "per cent from 0 to 100", float),
        "days": Setting("late_days", _whole(0, 365), "whole days from 0 to 365"),
    },
    "extensions": {},
    "written": {
        **{f"question_{number}": _QUESTION for number in QUESTION_POINTS},
        "guide": Setting("guide", lambda value: isinstance(value, str) and len(value) <= 20_000, "a text in markdown"),
    },
    "variants": {"families": Setting("families", _is_families, 'a list of families such as ["A", "B"]', tuple)},
    "confinement": {
        "minimum": Setting("min_confinement", _one_of("full", "seccomp", "none"), '"full", "seccomp" or "none"')
    },
}


def suggestion(key: str, section: str) -> str:
    """Say what may have been meant: a key of another section, a similar key, or all keys there are."""
    for other, keys in KEYS.items():
        if key in keys and other != section:
            return f"; it belongs {f'into [{other}]' if other else 'to the top of the file, before all sections'}"
    known = list(KEYS[section]) if section else [*KEYS[""], *(name for name in KEYS if name)]
    if close := get_close_matches(key, known, n=1, cutoff=0.5):
        return f"; did you mean {close[0]}?"
    if elsewhere := get_close_matches(key, [name for keys in KEYS.values() for name in keys], n=1, cutoff=0.75):
        section = next(name for name, keys in KEYS.items() if elsewhere[0] in keys)
        return f"; did you mean {elsewhere[0]} in [{section}]?"
    return f"; known here are {', '.join(known)}"
