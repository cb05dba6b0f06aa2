"""The folder of a run as people left it: the course in force, marks and overrides, merged into its results."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import msgspec

from autograder.course import Course
from autograder.marking.answers import Answer, answers
from autograder.marking.marks import Mark, read_marks
from autograder.marking.merging import merged
from autograder.marking.overrides import FILE as OVERRIDES
from autograder.marking.overrides import check_overrides, read_overrides
from autograder.marking.tables import refuse
from autograder.verdicts import Result
from autograder.writing import write_whole

COURSE = "course.json"


@dataclass(frozen=True)
class Decided:
    """A run with everything that people decided.

    Parameters
    ----------
    results : tuple of Result
        What every report and export shows.
    stored : tuple of Result
        What the machine said.
    course : Course
        The settings in force.
    marks : dict
        (submission, question) -> Mark.
    notes : tuple of str
        For the person at the keyboard.
    """

    results: tuple[Result, ...]
    stored: tuple[Result, ...]
    course: Course
    marks: dict[tuple[str, str], Mark]
    notes: tuple[str, ...] = ()

    def answers(self, names: dict[str, str] | None = None) -> list[Answer]:
        """List the written answers, under the names that are given or their own."""
        return answers(self.stored, self.marks, self.course, names)


def decided(
    out: Path, stored: Sequence[Result], course: Course | None = None, *, strict: bool = True, complete: bool = True
) -> Decided:
    """Merge the results of a run with what lies in its folder.

    Parameters
    ----------
    out : Path
        The folder.
    stored : sequence of Result
        The results in it.
    course : Course, optional
        The settings to use; without it those that were last used in this folder.
    strict : bool
        Whether an override that changes nothing is an error; else it is a note.
    complete : bool
        Whether `stored` is the whole class, so that a name that is not in it is worth a note.

    Raises
    ------
    UsageError
        Where marks or overrides are unusable; it names file, line and reason.
    """
    course = course or stored_course(out) or Course()
    marks, overrides = read_marks(out), read_overrides(out)
    repointed = merged(stored, course=course)
    complaints = check_overrides(overrides, repointed)
    if strict:
        refuse(out / OVERRIDES, complaints)
    bad = {line for line, _ in complaints}
    notes = [f"{out / OVERRIDES}, line {line}, changes nothing: {reason}." for line, reason in complaints if complete]
    results = merged(stored, marks, [one for one in overrides if one.line not in bad], course)
    lost = sorted({name for name, _ in marks} - {result.submission for result in stored})
    if lost and complete:
        notes.append(f"Marks are kept for {', '.join(lost[:3])}{', ...' * (len(lost) > 3)}, without a result here.")
    found = Decided(results, tuple(stored), course, marks)
    stale = [one for one in found.answers() if one.stale]
    if stale:
        notes.append(
            f"{len(stale)} written answers have changed since they were marked and wait again: "
            f"{', '.join(f'{one.submission} ({one.question})' for one in stale[:5])}{', ...' * (len(stale) > 5)}."
        )
    return Decided(results, tuple(stored), course, marks, tuple(notes))


def stored_course(out: Path) -> Course | None:
    """Return the settings that were last used in a folder; None where none are stored."""
    try:
        return msgspec.json.decode((out / COURSE).read_bytes(), type=Course)
    except (OSError, msgspec.MsgspecError):
        return None


def store_course(out: Path, course: Course) -> None:
    """Keep the settings in force, so that every later command finds them."""
    data = msgspec.json.encode(asdict(course), order="deterministic")
    write_whole(out / COURSE, msgspec.json.format(data, indent=2) + b"\n")
