"""Finds out what is to blame for a wrong verdict, by trying: again alone, with the defaults, with one setting only."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

from autograder.audit.cases import Case
from autograder.course import Course

MACHINE = "The machine"
SETTING = "A setting"
GRADER = "The grader itself"
MOST = 12  # cases that are tried again: a sharp exam has none, and what spoils many shows in a few

_NAMES = {
    "points": "[points]",
    "follow_through": "[grading] follow_through",
    "examples": "[grading] examples",
    "seed": "[grading] seed",
    "time_limit": "[limits] time",
    "memory_mib": "[limits] memory",
    "output_mib": "[limits] output",
}
_LIMITS = ("timeout", "memory")

Wrong = Callable[[Sequence[Case], Course, int], list[str]]
"""Which outcome each case has under a course with this number of workers: "" where all of it is right."""


@dataclass(frozen=True)
class Blame:
    """What is to blame for the wrong verdict of a case, and what to do."""

    what: str
    why: str


def blame(cases: Sequence[Case], course: Course, wrong: Wrong) -> dict[str, Blame]:
    """Try wrong cases again, and say of each what is to blame.

    Parameters
    ----------
    cases : sequence of Case
        Those that were judged wrongly; the first few of them are tried.
    course : Course
        The settings; seed and examples among them.
    wrong : callable
        Judges cases under other settings.

    Returns
    -------
    dict
        Name of the case -> what is to blame.
    """
    left = list(cases[:MOST])
    found: dict[str, Blame] = {}
    told = (
        f"{MACHINE} is busy or slow: what was wrong among others is right alone. Run the audit again when it is idle."
    )
    left = _settle(left, wrong(left, course, 1), found, Blame(MACHINE, told))
    settings = differing(course)
    if left and settings:
        plain = Course(seed=0, stages=course.stages)
        bad = [case for case, outcome in zip(left, wrong(left, plain, 1), strict=True) if outcome]
        for name, value in settings.items():
            suspects = [case for case in left if case not in bad and case.name not in found]
            if suspects:
                outcomes = wrong(suspects, replace(plain, **{name: value}), 1)
                why = f"{SETTING}: {_told(name, course)}. With the default alone the verdict is right."
                _settle(suspects, ["" if outcome else "x" for outcome in outcomes], found, Blame(SETTING, why))
        together = (
            f"{SETTING}: {', '.join(_told(name, course) for name in settings)}; only together. The defaults are right."
        )
        found |= {one.name: Blame(SETTING, together) for one in left if one not in bad and one.name not in found}
        left = bad
    for case, outcome in zip(left, wrong(left, course, 1) if left else [], strict=True):
        if outcome in _LIMITS:
            why = f"{MACHINE} is too slow or too small for the limits, also alone; raise [limits] time or memory."
            found[case.name] = Blame(MACHINE, why)
        else:
            why = (
                f"{GRADER}, not a setting and not the load: it is wrong again alone, and with the defaults. Report it."
            )
            found[case.name] = Blame(GRADER, why)
    return found


def differing(course: Course) -> dict[str, Any]:
    """Return the settings of a course on which verdicts depend and that are not the defaults."""
    plain, own = asdict(Course(seed=0)), asdict(course)
    return {name: own[name] for name in _NAMES if own[name] != plain[name]}


def _settle(cases: Sequence[Case], outcomes: Sequence[str], found: dict[str, Blame], what: Blame) -> list[Case]:
    """Blame this where the outcome is right now; return the others."""
    found |= {case.name: what for case, outcome in zip(cases, outcomes, strict=True) if not outcome}
    return [case for case, outcome in zip(cases, outcomes, strict=True) if outcome]


def _told(name: str, course: Course) -> str:
    value, plain = getattr(course, name), getattr(Course(seed=0), name)
    if name == "points":
        return ", ".join(
            f"[points] {stage} = {points:g} (default {plain[stage]:g})"
            for stage, points in value.items()
            if points != plain[stage]
        )
    return f"{_NAMES[name]} = {value:g} (default {plain:g})"
