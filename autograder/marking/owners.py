"""Whose a submission is, by word of the staff: owners.csv in the folder of a run, written by `grade --is`."""

from __future__ import annotations

import csv
import io
from collections.abc import Collection, Mapping
from difflib import get_close_matches
from pathlib import Path

from autograder.errors import UsageError
from autograder.marking.tables import read_table
from autograder.writing import write_whole

FILE = "owners.csv"
COLUMNS = ("submission", "student_id")


def read_owners(out: Path) -> dict[str, str]:
    """Read what staff have decided so far: submission -> student id; {} where there is no file.

    Raises
    ------
    UsageError
        Where the file cannot be read.
    """
    path = out / FILE
    if not path.exists():
        return {}
    rows = read_table(path, COLUMNS)
    return {row["submission"]: row["student_id"] for row in rows if row["submission"] and row["student_id"]}


def decide(
    out: Path, given: Mapping[str, str], submissions: Collection[str], students: Collection[str] | None
) -> dict[str, str]:
    """Take what staff say now together with what they said before; nothing is written.

    Parameters
    ----------
    out : Path
        The folder of the run.
    given : mapping
        Submission -> student id; "" takes a decision back.
    submissions : collection of str
        What there is to decide on.
    students : collection of str or None
        The ids of the class; None where there is no roster.

    Raises
    ------
    UsageError
        Where a submission is not there, or an id is nobody's.
    """
    spelled = None if students is None else {one.casefold(): one for one in students}
    found = dict(read_owners(out))
    for name, student in given.items():
        if name not in submissions:
            raise UsageError(f"--is {name}={student}: there is no submission {name!r}{_near(name, submissions)}.")
        if spelled is not None and student and student.casefold() not in spelled:
            near = _near(student, students or ())
            raise UsageError(f"--is {name}={student}: the roster has nobody with the id {student!r}{near}.")
        found[name] = student if spelled is None else spelled.get(student.casefold(), "")
    return {name: student for name, student in found.items() if student}


def store_owners(out: Path, owners: Mapping[str, str]) -> None:
    """Keep what staff have decided, so that every later command knows it."""
    if not owners and not (out / FILE).exists():
        return
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(COLUMNS)
    writer.writerows(sorted(owners.items()))
    write_whole(out / FILE, file.getvalue().encode())


def _near(name: str, known: Collection[str]) -> str:
    near = get_close_matches(name, known, 1)
    return f" (near to it: {near[0]!r})" if near else ""
