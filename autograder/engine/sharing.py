"""Keep a class in memory: verdicts that many submissions share are one object, so that a class of ten thousand fits."""

from __future__ import annotations

from msgspec.structs import replace

from autograder.verdicts import CheckVerdict, Result, StageVerdict


class Shared:
    """Gives back for equal verdicts the same one; what was passed is equal for nearly everybody."""

    def __init__(self) -> None:
        self._checks: dict[CheckVerdict, CheckVerdict] = {}
        self._stages: dict[StageVerdict, StageVerdict] = {}

    def result(self, result: Result) -> Result:
        """Return a result that equals the given one."""
        return replace(result, stages=tuple(self._stage(stage) for stage in result.stages))

    def _stage(self, stage: StageVerdict) -> StageVerdict:
        checks = tuple(self._check(check) for check in stage.checks)
        same = replace(stage, checks=checks)
        if any(check.counterexample is not None for check in checks):
            return same  # it holds a dict, and hardly anybody has the same one
        return self._stages.setdefault(same, same)

    def _check(self, check: CheckVerdict) -> CheckVerdict:
        if check.counterexample is not None:
            return check
        return self._checks.setdefault(check, check)
