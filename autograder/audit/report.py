"""What an audit found, as values: every case with its cells, the kill matrix, and what each check is good for."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from autograder.audit.blame import Blame, blame
from autograder.audit.cases import SPECIMENS, Case, all_cases
from autograder.audit.examine import Done, Examined, examine
from autograder.audit.expectation import Cell, compare
from autograder.audit.matrix import Power, kill_matrix, powers
from autograder.audit.words import meaning
from autograder.course import Course
from autograder.engine.exam import draw_exam
from autograder.stages.base import Stage
from autograder.stages.catalogue import all_stages
from autograder.verdicts import StageVerdict

FAULTS = ("false alarm", "miss", "misjudged")


@dataclass(frozen=True)
class Row:
    """One case: what was expected of it and what came, stage by stage."""

    kind: str
    name: str
    cells: tuple[Cell, ...]
    sentence: str = ""
    blame: Blame | None = None

    @property
    def wrong(self) -> tuple[Cell, ...]:
        """The cells that are not as expected."""
        return tuple(cell for cell in self.cells if not cell.right)


@dataclass(frozen=True)
class Audit:
    """The whole audit.

    Parameters
    ----------
    seed, examples : int
        What the exam was drawn from.
    confinement : str
        The level under which the cases ran.
    rows : tuple of Row
        Every case.
    matrix : dict
        Stage to slip to one truth value a check.
    powers : tuple of Power
        What every check is good for.
    """

    seed: int
    examples: int
    confinement: str
    rows: tuple[Row, ...]
    matrix: dict[str, dict[str, tuple[bool, ...]]]
    powers: tuple[Power, ...]

    @property
    def wrong(self) -> tuple[Row, ...]:
        """The cases with a wrong cell."""
        return tuple(row for row in self.rows if row.wrong)

    @property
    def idle(self) -> tuple[Power, ...]:
        """The checks that catch nothing alone and that nobody justifies."""
        return tuple(power for power in self.powers if not power.justified)

    @property
    def clean(self) -> bool:
        """Whether every cell is right and every check has its place."""
        return not self.wrong and not self.idle

    def faults(self) -> dict[str, int]:
        """Count the wrong cells by what is wrong with them."""
        found = [cell.fault for row in self.rows for cell in row.wrong]
        return {fault: found.count(fault) for fault in FAULTS}

    def plain(self) -> dict[str, Any]:
        """Return everything as data for JSON."""
        checks = {stage: [power.check for power in self.powers if power.stage == stage] for stage in self.matrix}
        return {
            "clean": self.clean,
            "seed": self.seed,
            "examples": self.examples,
            "confinement": self.confinement,
            "faults": self.faults(),
            "cases": [
                {
                    "kind": row.kind,
                    "name": row.name,
                    "right": not row.wrong,
                    "cells": [
                        {
                            "stage": cell.stage,
                            "expected": cell.expected,
                            "got": cell.got,
                            "right": cell.right,
                            "meaning": meaning(cell),
                        }
                        for cell in row.cells
                    ],
                    "blame": "" if row.blame is None else row.blame.why,
                }
                for row in self.rows
            ],
            "kill_matrix": {
                stage: {slip: dict(zip(checks[stage], row, strict=True)) for slip, row in rows.items()}
                for stage, rows in self.matrix.items()
            },
            "checks": [
                {
                    "stage": power.stage,
                    "check": power.check,
                    "ladder": power.ladder,
                    "caught": power.caught,
                    "first": power.first,
                    "only": list(power.only),
                    "reason": power.reason,
                }
                for power in self.powers
            ],
        }


def audit(
    course: Course,
    seed: int,
    examples: int,
    on_done: Done = lambda *_: None,
    *,
    specimens: Path = SPECIMENS,
    wanted: Callable[[Case], bool] = lambda _: True,
    examiner: Callable[..., Examined] = examine,
) -> Audit:
    """Let the grader grade everything whose verdict is known.

    Parameters
    ----------
    course : Course
        Points, stages and limits; a course that uses some stages is audited on these.
    seed, examples : int
        The exam to draw.
    on_done : callable
        Told after every case.
    specimens : Path
        The folder of the specimens.
    wanted : callable
        Which cases to take; all, if nothing is said.
    examiner : callable
        Runs the sources; the engine's worker processes, if nothing is said.

    Returns
    -------
    Audit
        What came, beside what was expected.
    """
    stages = tuple(stage for stage in all_stages() if stage.name in course.stages)
    cases = [case for case in all_cases(stages, specimens) if wanted(case)]
    course = replace(course, seed=seed, examples=examples)

    def judged(some: Sequence[Case], under: Course, workers: int | None, told: Done) -> Examined:
        exam = draw_exam(under.seed or 0, under.examples)
        return examiner([case.source for case in some], stages, exam, under, told, workers)

    def wrong(some: Sequence[Case], under: Course, workers: int) -> list[str]:
        found = judged(some, under, workers, lambda *_: None)
        rows = [_row(case, verdicts, under) for case, verdicts in zip(some, found.verdicts, strict=True)]
        return [row.wrong[0].got.partition(":")[0] if row.wrong else "" for row in rows]

    examined = judged(cases, course, None, on_done)
    graded = list(zip(cases, examined.verdicts, strict=True))
    rows = tuple(_row(case, verdicts, course) for case, verdicts in graded)
    bad = [case for case, row in zip(cases, rows, strict=True) if row.wrong]
    reasons = blame(bad, course, wrong) if bad else {}
    rows = tuple(replace(row, blame=reasons.get(row.name)) if row.wrong else row for row in rows)
    matrix = {stage.name: _matrix(stage, graded) for stage in stages}
    found = tuple(power for stage in stages if matrix[stage.name] for power in powers(stage, matrix[stage.name]))
    return Audit(seed, examples, examined.confinement, rows, {k: v for k, v in matrix.items() if v}, found)


def _row(case: Case, verdicts: Sequence[StageVerdict], course: Course) -> Row:
    cells = compare(case.expected, verdicts, follow_through=course.follow_through > 0)
    return Row(case.kind, case.name, tuple(cells), case.expected.sentence)


def _matrix(stage: Stage, graded: Sequence[tuple[Case, Any]]) -> dict[str, tuple[bool, ...]]:
    return kill_matrix(stage, ((case.name, verdicts) for case, verdicts in graded if case.slip_of == stage.name))
