"""The marks of written answers: one file in the folder of a run, which no run of the grader writes over."""

from __future__ import annotations

import csv
import hashlib
import io
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from autograder.marking.spreadsheets import bare, cell, exact
from autograder.marking.tables import number, read_table, refuse
from autograder.writing import write_whole

FILE = "marks.csv"
COLUMNS = ("submission", "question", "points", "of", "comment", "answer")
LONGEST_COMMENT = 4000


@dataclass(frozen=True)
class Mark:
    """What a reader gave for one answer.

    Parameters
    ----------
    submission, question : str
        Which answer.
    points : float
        What it earned.
    of : float
        Points of the question when it was marked.
    comment : str
        For the student.
    answer : str
        Digest of the answer that was read.
    """

    submission: str
    question: str
    points: float
    of: float
    comment: str = ""
    answer: str = ""

    @property
    def key(self) -> tuple[str, str]:
        """Submission and question."""
        return self.submission, self.question


Marks = Mapping[tuple[str, str], Mark]


def digest(text: str) -> str:
    r"""Identify an answer by its words; blanks do not count.

    Examples
    --------
    >>> digest("zero,  because\nit is linear") == digest("zero, because it is linear")
    True
    """
    return hashlib.sha256(" ".join(text.split()).encode()).hexdigest()[:16]


def read_marks(out: Path) -> dict[tuple[str, str], Mark]:
    """Read the marks of a run; none where there is no file yet.

    Raises
    ------
    UsageError
        Where somebody has edited the file into something that is none; it names the lines.
    """
    path = out / FILE
    if not path.exists():
        return {}
    found: dict[tuple[str, str], Mark] = {}
    complaints = []
    for row in read_table(path, COLUMNS[:4]):
        points, most = number(row["points"]), number(row["of"])
        if points is None or most is None or not 0 <= points <= most:
            complaints.append((row.line, f"points are {row['points']!r} of {row['of']!r}, expected 0 to the maximum"))
            continue
        mark = Mark(bare(row["submission"]), row["question"], points, most, bare(row["comment"]), row["answer"])
        if mark.key in found:
            complaints.append((row.line, f"{mark.submission} has a mark for question {mark.question} already"))
        found[mark.key] = mark
    refuse(path, complaints)
    return found


def write_marks(out: Path, marks: Iterable[Mark]) -> None:
    """Write all marks in one step, sorted; the same marks give the same bytes."""
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(COLUMNS)
    for mark in sorted(marks, key=lambda one: one.key):
        values = (mark.question, exact(mark.points), exact(mark.of), cell(mark.comment), mark.answer)
        writer.writerow((cell(mark.submission), *values))
    data = file.getvalue().encode()
    path = out / FILE
    if not path.exists() or path.read_bytes() != data:
        write_whole(path, data)
