"""Moodle's grading worksheet with the marks filled in; all else stays byte for byte."""

from __future__ import annotations

import html
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from autograder.errors import UsageError
from autograder.exports.marks import decimal_sign, mark, same_maximum
from autograder.exports.moodle.headings import Columns, columns, may_change, number_of
from autograder.exports.pairing import Pairs, Person, listing, pair, remarks
from autograder.exports.sheet import Row, Sheet, read_sheet
from autograder.verdicts import Result


@dataclass(frozen=True)
class Filled:
    """The new worksheet, what a human should know, who is who, and whose folder is called what."""

    data: bytes
    notes: tuple[str, ...]
    pairs: Pairs
    folders: Mapping[int, str]


def fill_worksheet(
    data: bytes,
    name: str,
    results: Sequence[Result],
    *,
    comments: Mapping[str, str] | None = None,
    headings: Mapping[str, str] | None = None,
    given: Mapping[str, str] | None = None,
    any_maximum: bool = False,
) -> Filled:
    """Write scores into the grade column, and comments where they are given.

    Moodle skips a line whose mark was changed on the site after the worksheet was downloaded; so the
    column with that time stays as it is. A line that cannot be changed there stays as it is, and so does
    a comment that somebody wrote; both are said.

    Parameters
    ----------
    data : bytes
        The worksheet as Moodle exported it.
    name : str
        What messages call it.
    results : sequence of Result
        What was graded.
    comments : mapping, optional
        Submission -> text for the column of comments.
    headings : mapping, optional
        identifier, grade, maximum, name, email, comments or changeable -> heading, where the language is not known.
    given : mapping, optional
        Submission -> identifier, where a human has decided.
    any_maximum : bool
        Write the points even where Moodle has another maximum.

    Raises
    ------
    UsageError
        Where the file is no worksheet, a column cannot be told, or a mark could be anybody's.
    """
    sheet, places = _opened(data, name, headings or {})
    if comments and places.comments < 0:
        raise UsageError(
            f"{name} has no column for comments; switch on 'Feedback comments' in the assignment, name the column "
            "with --comments-column, or leave the comments out."
        )
    rows = [row for row in sheet.rows[1:] if not row.blank]
    for row in rows:
        if len(row) != len(sheet.rows[0]):
            raise sheet.wrong(row.line, f"it has {len(row)} cells, expected {len(sheet.rows[0])} as in the headings")
    people = _people(sheet, places)
    pairs = pair(results, people, name, given)
    left = _fill(sheet, places, rows, pairs, comments or {}, any_maximum=any_maximum)
    notes = [*remarks(pairs, people, name), *left]
    if places.guessed:
        shown = ", ".join(f"{which} = {sheet.rows[0][getattr(places, which)]!r}" for which in places.guessed)
        notes.append(f"Found by what stands in them, for the headings are not known: {shown}.")
    folders = {person.line: folder_name(person.name, person.ids[1]) for person in people}
    return Filled(sheet.encode(), tuple(notes), pairs, folders)


def participants(data: bytes, name: str, headings: Mapping[str, str]) -> list[Person]:
    """List everybody of a worksheet: `ids` are identifier, number, and the address where it has one.

    Raises
    ------
    UsageError
        Where the file is no worksheet, or a column cannot be told.
    """
    return _people(*_opened(data, name, headings))


def _opened(data: bytes, name: str, headings: Mapping[str, str]) -> tuple[Sheet, Columns]:
    sheet = read_sheet(data, name)
    if not sheet.rows:
        raise UsageError(f"{name} is empty; expected the grading worksheet of an assignment.")
    return sheet, columns(sheet, headings)


def _fill(
    sheet: Sheet,
    places: Columns,
    rows: Sequence[Row],
    pairs: Pairs,
    comments: Mapping[str, str],
    *,
    any_maximum: bool,
) -> list[str]:
    """Write marks and comments into the rows that have a result; say which were left as they are."""
    decimal = "."
    locked, commented = [], []
    for row in rows:
        result = pairs.by_line.get(row.line)
        maximum = row[places.maximum] if places.maximum >= 0 else ""
        if maximum.strip():
            decimal = decimal_sign(maximum)
        if result is None or result.score is None:
            continue
        if not may_change(row, places.changeable):
            locked.append(result.submission)
            continue
        if not any_maximum:
            same_maximum([result], maximum, f"{sheet.name}, line {row.line}: the assignment")
        sheet.write(row, places.grade, mark(result.score, decimal))
        comment = _comment(comments[result.submission]) if comments else ""
        if comment and row[places.comments].strip() not in {"", "-", comment}:
            commented.append(result.submission)
        elif comment:
            sheet.write(row, places.comments, comment)
    notes = []
    if locked:
        notes.append(f"Cannot be changed in Moodle: {listing(locked)}; the line stays as it was.")
    if commented:
        notes.append(f"Have another comment already: {listing(commented)}; it stays. Empty the cell to have it filled.")
    return notes


def folder_name(name: str, number: str) -> str:
    """Name a student's folder as Moodle does; it finds the student by what stands between the first underscores.

    Examples
    --------
    >>> folder_name("Ann_Mary O/Neill", "42")
    'Ann Mary O Neill_42_assignsubmission_file_'
    """
    return re.sub(r"[_/\\\x00-\x1f\x7f:*?\"<>|]+", " ", name).strip(". ") + f"_{number}_assignsubmission_file_"


def _people(sheet: Sheet, places: Columns) -> list[Person]:
    people = []
    for row in sheet.rows[1:]:
        if row.blank:
            continue
        number = number_of(sheet, row, places.identifier)
        name = row[places.name].strip() if places.name >= 0 else ""
        shown = name or re.sub(r"\d+$", "", row[places.identifier].strip()).strip() or "participant"
        address = (row[places.email].strip(),) if places.email >= 0 else ()
        ids = (row[places.identifier].strip(), number, *address)
        download = folder_name(shown, number).removesuffix("_assignsubmission_file_")
        people.append(Person(row.line, ids, (download,), shown, f"Moodle {number}"))
    if not people:
        raise UsageError(f"{sheet.name} has no participant; expected a line for each below the headings.")
    return people


def _comment(text: str) -> str:
    """Write a comment as the HTML that Moodle takes it for; it begins with a tag, so it is no formula either."""
    return f"<pre>{html.escape(text.rstrip())}</pre>"
