"""Changes by hand: overrides.csv in the folder of a run, which the grader reads and never writes."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path

from autograder.marking.spreadsheets import bare, plain
from autograder.marking.tables import number, read_table, refuse
from autograder.verdicts import Result

FILE = "overrides.csv"
COLUMNS = ("student", "stage", "points", "reason", "who", "when")
TOTAL = "total"


@dataclass(frozen=True)
class Override:
    """One line: from now on `student` has `points` in `stage`, whatever the machine or a rule says."""

    line: int
    student: str
    stage: str
    points: float
    reason: str
    who: str
    when: str


def read_overrides(out: Path) -> tuple[Override, ...]:
    """Read the overrides of a run; none where there is no file.

    Raises
    ------
    UsageError
        With line and reason of everything that is no override.
    """
    path = out / FILE
    if not path.exists():
        return ()
    found = []
    complaints = []
    for row in read_table(path, COLUMNS):
        points = number(row["points"])
        empty = [name for name in COLUMNS if not row[name]]
        if empty:
            complaints.append((row.line, f"{', '.join(empty)} is empty, expected all of {', '.join(COLUMNS)}"))
        elif points is None or points < 0:
            complaints.append((row.line, f"points are {row['points']!r}, expected a number from 0"))
        else:
            words = [bare(row[name]) for name in ("reason", "who", "when")]
            found.append(Override(row.line, bare(row["student"]), row["stage"], points, *words))
    refuse(path, complaints)
    return tuple(found)


def whose(overrides: Sequence[Override], results: Sequence[Result]) -> dict[str, list[Override]]:
    """Give each submission its overrides, by its name or by the student's id; unknown students are left out."""
    known = called(results)
    found: dict[str, list[Override]] = {}
    for override in overrides:
        for name in known.get(plain(override.student), ()):
            found.setdefault(name, []).append(override)
    return found


def called(results: Sequence[Result]) -> dict[str, list[str]]:
    """Return which submissions go by a name that people may type: their own, or else the student's id."""
    found: dict[str, list[str]] = {}
    for result in results:
        if result.student_id:
            found.setdefault(plain(result.student_id), []).append(result.submission)
    return found | {plain(result.submission): [result.submission] for result in results}


def check_overrides(
    overrides: Sequence[Override], results: Sequence[Result], aside: Collection[str] = ()
) -> list[tuple[int, str]]:
    """List line and reason of every override that changes nothing or too much: unknown, beyond the maximum, twice.

    A line about somebody who is kept aside changes nothing, and is right again when that upload comes back.
    """
    names = called(results)
    most = {stage.name: stage.max_score for result in results for stage in result.stages}
    bonus = {stage.name: stage.max_score for result in results for stage in result.stages if stage.bonus}
    whole = max((result.max_score for result in results), default=0.0) + sum(bonus.values())
    complaints = []
    seen: dict[tuple[str, str], Override] = {}
    for one in overrides:
        theirs = names.get(plain(one.student), [])
        if not theirs and one.student in aside:
            continue
        before = next((seen[name, one.stage] for name in theirs if (name, one.stage) in seen), None)
        if not theirs:
            near = get_close_matches(one.student, names, 1)
            guess = f"; did you mean {near[0]}" if near else ""
            complaints.append((one.line, f"there is no submission or student id {one.student!r}{guess}"))
        elif one.stage != TOTAL and one.stage not in most:
            complaints.append((one.line, f"stage is {one.stage!r}, expected {', '.join(most)} or {TOTAL}"))
        elif one.stage in most and one.points > most[one.stage]:
            complaints.append((one.line, f"{one.points:g} points, but {one.stage} has {most[one.stage]:g}"))
        elif one.stage == TOTAL and one.points > whole:
            complaints.append((one.line, f"{one.points:g} points, but there are {whole:g}, bonus included"))
        elif before is not None:
            called_so = "" if before.student == one.student else f", as {before.student}"
            reason = f"{one.student} has an override of {one.stage} in line {before.line} already{called_so}"
            complaints.append((one.line, reason))
        seen |= {(name, one.stage): one for name in theirs if (name, one.stage) not in seen}
    return complaints
