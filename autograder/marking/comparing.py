"""Two runs side by side: whose mark moved, by which stage and check, and why."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from autograder.verdicts import Result, StageVerdict

_SAME = 1e-9


@dataclass(frozen=True)
class Moved:
    """One submission whose mark is another one: None where it is in one run only or has no score."""

    submission: str
    before: float | None
    after: float | None
    reasons: tuple[str, ...]

    @property
    def by(self) -> float | None:
        """How far the mark moved."""
        return None if self.before is None or self.after is None else self.after - self.before


def moved(before: Iterable[Result], after: Iterable[Result]) -> list[Moved]:
    """List every submission with another score, another stage, or another check, sorted by name."""
    old = {result.submission: result for result in before}
    new = {result.submission: result for result in after}
    found = []
    for name in sorted(old.keys() | new.keys()):
        one, other = old.get(name), new.get(name)
        if one is None or other is None:
            there = "only in the second" if one is None else "only in the first"
            present = one or other
            score = None if present is None else present.score
            found.append(Moved(name, None if one is None else score, None if other is None else score, (there,)))
            continue
        reasons = _reasons(one, other)
        if reasons or not _same(one.score, other.score):
            found.append(Moved(name, one.score, other.score, tuple(reasons)))
    return found


def _same(one: float | None, other: float | None) -> bool:
    if one is None or other is None:
        return one is other
    return abs(one - other) < _SAME


def _reasons(one: Result, other: Result) -> list[str]:
    reasons = []
    if one.status != other.status:
        reasons.append(f"status: {one.status} -> {other.status}{f': {other.message}' if other.message else ''}")
    if one.variant != other.variant:
        reasons.append(f"variant: {one.variant} -> {other.variant}")
    old = {stage.name: stage for stage in one.stages}
    for stage in other.stages:
        before = old.pop(stage.name, None)
        if before is None:
            reasons.append(f"{stage.name}: {stage.score:g}, was not graded before")
        else:
            reasons += _stage(before, stage)
    reasons += [f"{name}: {stage.score:g} -> not graded" for name, stage in old.items()]
    said = {each.said for each in one.adjustments}
    reasons += [each.said for each in other.adjustments if each.said not in said]
    still = {each.said for each in other.adjustments}
    reasons += [f"no longer: {each.said}" for each in one.adjustments if each.said not in still]
    return reasons


def _stage(before: StageVerdict, after: StageVerdict) -> list[str]:
    old = {check.name: check for check in before.checks}
    changed = []
    for check in after.checks:
        was = old.pop(check.name, None)
        if was is None:
            changed.append(f"{check.name} is new and {_word(check.passed)}")
        elif was.passed != check.passed:
            reason = check.message or was.message
            changed.append(
                f"{check.name} {_word(was.passed)} -> {_word(check.passed)}{f' ({reason})' if reason else ''}"
            )
        elif not _same(was.points, check.points):
            changed.append(f"{check.name} is worth {check.points:g} instead of {was.points:g}")
    changed += [f"{name} is gone" for name in old]
    if _same(before.score, after.score) and not changed and before.status == after.status:
        return []
    worth = "" if _same(before.max_score, after.max_score) else f" (of {before.max_score:g} -> of {after.max_score:g})"
    head = f"{after.name}: {before.score:g} -> {after.score:g}{worth}"
    if not changed:
        why = after.message or f"{before.status} -> {after.status}"
        return [head if worth else f"{head}: {why}"]
    return [f"{head}: {'; '.join(changed)}"]


def _word(passed: bool) -> str:
    return "passed" if passed else "failed"
