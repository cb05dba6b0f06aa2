"""Stored verdicts under other points: which checks passed stays, what they are worth changes."""

from __future__ import annotations

from msgspec.structs import replace

from autograder.course import Course
from autograder.errors import UsageError
from autograder.verdicts import CheckVerdict, StageVerdict

_SAME = 1e-5


def repointed(stage: StageVerdict, course: Course) -> StageVerdict:
    """Return the verdict of a stage with the points of a course; itself where nothing changes.

    Raises
    ------
    UsageError
        Where a stage that was graded with 0 points gets some: its checks have no shares to go by.
    """
    most = course.points[stage.name]
    if abs(most - stage.max_score) < _SAME and all(_is_paid(check, course) for check in stage.checks):
        return stage
    if stage.max_score <= 0:
        if most > 0:
            raise UsageError(f"{stage.name} was graded with 0 points, and is to have {most:g}; grade again with them.")
        return stage
    ratio = most / stage.max_score
    checks = tuple(_repointed(check, ratio, course) for check in stage.checks)
    if stage.status == "passed":
        score = most
    elif checks:
        score = sum(check.points for check in checks)
    else:
        score = stage.score * ratio
    return replace(stage, score=round(score, 6), max_score=float(most), checks=checks)


def _is_followed(check: CheckVerdict) -> bool:
    """Whether a wrong check was paid in part: it follows from an earlier mistake."""
    return not check.passed and check.points > 0


def _is_paid(check: CheckVerdict, course: Course) -> bool:
    return not _is_followed(check) or abs(check.points - check.max_points * course.follow_through) < _SAME


def _repointed(check: CheckVerdict, ratio: float, course: Course) -> CheckVerdict:
    most = round(check.max_points * ratio, 6)
    if _is_followed(check):
        return replace(check, points=round(most * course.follow_through, 6), max_points=most)
    return replace(check, points=most if check.passed else 0.0, max_points=most)
