"""The sheet of written answers: a table with empty points and comments to fill in, and how it is read back."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path

from autograder.marking.answers import Answer
from autograder.marking.marks import LONGEST_COMMENT, Mark, digest
from autograder.marking.spreadsheets import bare, cell, exact
from autograder.marking.tables import Row, number, read_table, refuse

FILE = "written.csv"
LAST = ".written.last.csv"  # as the grader wrote it last, beside the one that people fill in
COLUMNS = ("submission", "question", "max_points", "answer", "points", "comment")
_LONGEST_CELL = 30_000  # a spreadsheet cuts a cell at 32,767 characters


def sheet_text(answers: Sequence[Answer]) -> str:
    """Lay out the sheet: a row an answer; what has been marked already stands in it."""
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(COLUMNS)
    for one in answers:
        given = ("", "") if one.mark is None else (_points(one), cell(one.mark.comment))
        text = one.text if len(one.text) <= _LONGEST_CELL else one.text[:_LONGEST_CELL] + " [cut: see written.html]"
        writer.writerow((cell(one.name), one.question, exact(one.most), cell(text), *given))
    return file.getvalue()


def _points(answer: Answer) -> str:
    assert answer.mark is not None
    share = answer.most / answer.mark.of if answer.mark.of else 1.0
    return exact(round(answer.mark.points * share, 6))


@dataclass(frozen=True)
class Filled:
    """What a filled sheet says: marks, and the lines without points."""

    marks: tuple[Mark, ...]
    empty: tuple[tuple[int, str], ...]


def read_sheet(path: Path, answers: Sequence[Answer], key: Mapping[str, str] | None = None) -> Filled:
    """Read a filled sheet.

    Parameters
    ----------
    path : Path
        The sheet; needed are submission, question and points.
    answers : sequence of Answer
        What there is to mark, under the submissions' own names.
    key : mapping, optional
        Anonymous name -> submission.

    Raises
    ------
    UsageError
        With line and reason of every row that cannot be taken; then none is.
    """
    known = {(one.submission, one.question): one for one in answers}
    names = {one.submission for one in answers}
    rows = read_table(path, ("submission", "question", "points"))
    complaints: list[tuple[int, str]] = []
    empty: list[tuple[int, str]] = []
    found: dict[tuple[str, str], tuple[Mark, int]] = {}
    last = _written(path.with_name(LAST)) if path.name == FILE else set()
    for row in rows:
        name = _submission(row["submission"], names, key or {})
        answer = known.get((name, row["question"]))
        problem = _problem(row, name, names, answer)
        if problem:
            complaints.append((row.line, problem))
        elif answer is not None and not row["points"]:
            empty.append((row.line, f"no points for question {answer.question} of {row['submission']}"))
        elif answer is not None:
            points = number(row["points"])
            assert points is not None  # _problem looks at it
            mark = Mark(name, answer.question, points, _most(row, answer), bare(row["comment"]), digest(answer.text))
            if answer.mark is not None and tuple(row[column] for column in COLUMNS) in last:
                mark = answer.mark  # nobody has filled this row in since it was written; the mark may be newer
            before = found.get(mark.key)
            if before is not None and before[0] != mark:
                complaints.append((row.line, f"differs from line {before[1]}, which marks the same answer"))
            found[mark.key] = mark, row.line
    refuse(path, complaints)
    return Filled(tuple(mark for mark, _ in found.values()), tuple(empty))


def unread(path: Path, answers: Sequence[Answer], names: Mapping[str, str] | None = None) -> bool:
    """Whether a sheet holds points or comments that are in no mark: it must not be written over."""
    if not path.exists():
        return False
    given = {(one.name, one.question): one for one in answers}
    back = {anonymous: submission for submission, anonymous in (names or {}).items()}
    by_submission = {(one.submission, one.question): one for one in answers}
    known = _written(path.with_name(LAST))
    for row in read_table(path, ("submission", "question", "points", "comment")):
        if tuple(row[name] for name in COLUMNS) in known:
            continue  # as it was written last: nobody has filled it in since
        name = bare(row["submission"])
        one = given.get((name, row["question"])) or by_submission.get((back.get(name, name), row["question"]))
        points, comment = row["points"], bare(row["comment"])
        if not points and not comment:
            continue
        if one is None or one.mark is None:
            return True
        value, most = number(points), _most(row, one)
        scaled = value * one.most / most if value is not None and most else value
        if scaled is None or abs(scaled - float(_points(one))) > 1e-6 or comment != one.mark.comment.strip():
            return True
    return False


def _written(path: Path) -> set[tuple[str, ...]]:
    """Return the rows of the sheet as the grader wrote it last; none where it has not."""
    return {tuple(row[name] for name in COLUMNS) for row in read_table(path, COLUMNS)} if path.exists() else set()


def _most(row: Row, answer: Answer) -> float:
    """Return the maximum that points in a row are out of: what the sheet was written with, also where it changed."""
    stated = number(row["max_points"])
    return answer.most if stated is None or stated <= 0 else stated


def _submission(text: str, names: set[str], key: Mapping[str, str]) -> str:
    """Find whose row it is: a submission, as it is or defused, or an anonymous name."""
    if text in names:
        return text
    plain = bare(text)
    return plain if plain in names else key.get(text, plain)


def _problem(row: Row, name: str, names: set[str], answer: Answer | None) -> str:
    if name not in names:
        near = get_close_matches(name, names, 1)
        return f"there is no written answer of {name!r}" + (f"; did you mean {near[0]}" if near else "")
    if answer is None:
        return f"{name} has no answer to question {row['question']!r}"
    if not row["points"]:
        return f"a comment without points for question {answer.question} of {name}" if row["comment"] else ""
    points = number(row["points"])
    if points is None:
        return f"points are {row['points'][:40]!r}, expected a number from 0 to {answer.most:g}"
    if not 0 <= points <= _most(row, answer):
        return f"{points:g} points, but question {answer.question} has {_most(row, answer):g}"
    if len(row["comment"]) > LONGEST_COMMENT:
        return f"the comment is longer than {LONGEST_COMMENT} characters"
    return ""
