"""The kill matrix: which check catches which slip, and what would slip through without a check."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from autograder.stages.base import Stage
from autograder.verdicts import StageVerdict

Rows = Mapping[str, tuple[bool, ...]]
"""Slip to one truth value a check: whether the check catches it."""


@dataclass(frozen=True)
class Power:
    """What one check of one stage is good for.

    Parameters
    ----------
    stage, check, ladder : str
        Which check, and the ladder of cases that it is a rung of.
    caught : int
        How many slips of the stage it catches.
    first : int
        How many of them no simpler check of the ladder catches.
    only : tuple of str
        Those that no other check catches.
    reason : str
        Why the check is kept where it catches nothing alone; "" where none is given.
    """

    stage: str
    check: str
    ladder: str
    caught: int
    first: int
    only: tuple[str, ...]
    reason: str

    @property
    def justified(self) -> bool:
        """Whether the check earns its place, or somebody says why it has one."""
        return bool(self.only or self.reason)


def kill_matrix(stage: Stage, graded: Iterable[tuple[str, Sequence[StageVerdict]]]) -> dict[str, tuple[bool, ...]]:
    """Collect from graded slips of a stage which of its checks each of them fails."""
    found = {}
    for slip, verdicts in graded:
        (own,) = [verdict for verdict in verdicts if verdict.name == stage.name]
        found[slip] = tuple(not check.passed for check in own.checks)
    return found


def powers(stage: Stage, rows: Rows) -> list[Power]:
    """Say of every check of a stage what it catches, first, and alone."""
    return [
        Power(
            stage=stage.name,
            check=rung.name,
            ladder=stage.ladder.name,
            caught=sum(row[at] for row in rows.values()),
            first=sum(row[at] and not any(row[:at]) for row in rows.values()),
            only=tuple(slip for slip, row in rows.items() if row[at] and sum(row) == 1),
            reason=rung.reason,
        )
        for at, rung in enumerate(stage.ladder.rungs)
    ]
