"""The folder of a run as people left it: the course in force, marks and overrides, merged into its results."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from difflib import get_close_matches
from pathlib import Path

import msgspec

from autograder import __version__
from autograder.course import Course
from autograder.errors import UsageError
from autograder.marking.answers import Answer, answers
from autograder.marking.marks import Mark, read_marks
from autograder.marking.members import Members, read_members
from autograder.marking.merging import merged
from autograder.marking.overrides import FILE as OVERRIDES
from autograder.marking.overrides import TOTAL, Override, called, check_overrides, read_overrides
from autograder.marking.spreadsheets import plain
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
    members = read_members(out)
    everybody = (*stored, *absent(overrides, stored, members))
    complaints = check_overrides(overrides, merged(everybody, course=course), members.aside)
    if strict:
        refuse(out / OVERRIDES, complaints)
    bad = {line for line, _ in complaints}
    notes = [f"{out / OVERRIDES}, line {line}, changes nothing: {reason}." for line, reason in complaints if complete]
    notes += _misses(course, everybody, members, strict=strict) if complete else []
    results = merged(everybody, marks, [one for one in overrides if one.line not in bad], course)
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


def absent(overrides: Sequence[Override], stored: Sequence[Result], members: Members) -> list[Result]:
    """Make a result for everybody of the roster who handed in nothing and was given a total by hand."""
    there = called(stored)
    wanted = {plain(one.student) for one in overrides if one.stage == TOTAL and plain(one.student) not in there}
    return [
        Result(
            submission=name,
            student_id=name,
            status="rejected",
            message="Nothing was handed in.",
            score=0.0,
            max_score=0.0,
            confinement="",
            seed=0,
            grader_version=__version__,
            fingerprint="",
            seconds=0.0,
        )
        for name in members.roster
        if plain(name) in wanted
    ]


def _misses(course: Course, results: Sequence[Result], members: Members, *, strict: bool) -> list[str]:
    """Say which keys of [extensions] fit nobody; a slip of the pen is an error where all of the class is known."""
    known = {*called(results), *map(plain, members.roster), *map(plain, members.aside)}
    missed = [name for name in course.extensions if plain(name) not in known]
    said = []
    for name in missed:
        near = get_close_matches(plain(name), known, 1)
        guess = f"; did you mean {near[0]}?" if near else ""
        said.append(f"[extensions] {name} fits no submission or student id{guess}")
        if strict and (near or members.roster):
            raise UsageError(f"{said[-1]}{'' if near else '; the roster has nobody of this id.'}")
    return [one if one.endswith("?") else f"{one}." for one in said]


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
