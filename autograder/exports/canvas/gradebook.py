"""Canvas's exported gradebook with one column filled in; all else stays byte for byte."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from autograder.errors import UsageError
from autograder.exports.marks import mark, same_maximum
from autograder.exports.pairing import Pairs, Person, listing, pair, remarks
from autograder.exports.sheet import Row, Sheet, read_sheet
from autograder.verdicts import Result

_ASSIGNMENT = re.compile(r"(?P<title>.*) \((?P<number>\d+)\)", re.DOTALL)
_IDS = ("ID", "SIS User ID", "SIS Login ID", "Integration ID")
_EXPORT = "export it again in Canvas: Gradebook, Export"
EXCUSED = "EX"
_TEST_STUDENT = "student, test"  # Canvas's own, to look at a course as students do; no institution knows it


@dataclass(frozen=True)
class Filled:
    """The new file, what a human should know, and who is who."""

    data: bytes
    notes: tuple[str, ...]
    pairs: Pairs
    people: tuple[Person, ...]


def fill_gradebook(
    data: bytes,
    name: str,
    results: Sequence[Result],
    *,
    assignment: str = "",
    given: Mapping[str, str] | None = None,
    any_maximum: bool = False,
) -> Filled:
    """Write scores into the column of one assignment.

    Parameters
    ----------
    data : bytes
        The file as Canvas exported it.
    name : str
        What messages call it.
    results : sequence of Result
        What was graded.
    assignment : str
        Title, number or whole heading of the column; needed where there are several.
    given : mapping, optional
        Submission -> id, where a human has decided.
    any_maximum : bool
        Write the points even where Canvas has another maximum.

    Raises
    ------
    UsageError
        Where the file is no gradebook, the column cannot be told, or a mark could be anybody's.
    """
    sheet = read_sheet(data, name)
    top, header = _header(sheet)
    headings = [heading.strip() for heading in header.values]
    column = _column(sheet, headings, assignment)
    possible, rows = _rows(sheet, top, headings)
    people = tuple(_people(rows, headings))
    pairs = pair(results, people, name, given)
    points = possible[column] if possible is not None else ""
    if not any_maximum:
        same_maximum(pairs.by_line.values(), points, f"{name}: the column {headings[column]!r}")
    decimal = "," if sheet.separator != "," and possible is not None and _has_commas(possible) else "."
    excused = []
    for row in rows:
        result = pairs.by_line.get(row.line)
        if result is None or result.score is None:
            continue
        if row[column].strip().upper() == EXCUSED:
            excused.append(row[0])
            continue
        sheet.write(row, column, mark(result.score, decimal))
    notes = remarks(pairs, people, name)
    if excused:
        notes.append(f"Excused in Canvas: {listing(excused)}; the cell stays {EXCUSED}.")
    return Filled(sheet.encode(), tuple(notes), pairs, people)


def _header(sheet: Sheet) -> tuple[int, Row]:
    """Find the line of headings: Student first, an ID, and the Section after them."""
    for index, row in enumerate(sheet.rows[:4]):
        headings = [heading.strip() for heading in row.values]
        if "Student" in headings[0] or headings[:2] == ["LastName", "FirstName"]:
            missing = [heading for heading in ("ID", "Section") if heading not in headings]
            if missing:
                raise UsageError(
                    f"{sheet.name} has no column {missing[0]}, so whose line is whose cannot be told; {_EXPORT}."
                )
            return index, row
    raise UsageError(f"{sheet.name} does not begin with the headings Student, ID, ..., Section; {_EXPORT}.")


def _column(sheet: Sheet, headings: Sequence[str], wanted: str) -> int:
    first = headings.index("Section") + 1
    found: dict[int, tuple[str, str, str]] = {
        index: (heading, match["title"].strip(), match["number"])
        for index, heading in enumerate(headings)
        if index >= first and (match := _ASSIGNMENT.fullmatch(heading))
    }
    names = listing([heading for heading, _, _ in found.values()]) or "none"
    if not wanted:
        if len(found) == 1:
            return min(found)
        raise UsageError(f"{sheet.name} has {len(found)} assignments; say which with --assignment ({names}).")
    fitting = [index for index, forms in found.items() if wanted.strip() in forms]
    if len(fitting) == 1:
        return fitting[0]
    if fitting:
        numbers = " and ".join(found[index][2] for index in fitting)
        raise UsageError(f"{sheet.name} has {len(fitting)} assignments {wanted!r}; give the number instead: {numbers}.")
    raise UsageError(
        f"{sheet.name} has no assignment {wanted!r}; it has {names}. Create it in Canvas first, then export again."
    )


def _rows(sheet: Sheet, top: int, headings: Sequence[str]) -> tuple[Row | None, list[Row]]:
    """Split what follows the headings into the row of possible points and the students."""
    number = headings.index("ID")
    possible, students = None, []
    for row in sheet.rows[top + 1 :]:
        if row[0].strip() == "Points Possible":
            possible = row
        elif row[number].strip():
            if len(row) != len(headings):
                raise sheet.wrong(row.line, f"it has {len(row)} cells, expected {len(headings)} as in the headings")
            students.append(row)
    if not students:
        raise UsageError(f"{sheet.name} has no line with an ID, so whose marks are whose cannot be told; {_EXPORT}.")
    return possible, students


def _people(rows: Sequence[Row], headings: Sequence[str]) -> list[Person]:
    columns = [headings.index(heading) for heading in _IDS if heading in headings]
    people = []
    institution = headings.index("SIS User ID") if "SIS User ID" in headings else -1
    for row in rows:
        ids = tuple(row[column].strip() for column in columns if row[column].strip())
        name = ", ".join(row.values[:2]) if headings[0] == "LastName" else row[0]
        if name.strip().casefold() == _TEST_STUDENT and not (institution >= 0 and row[institution].strip()):
            continue
        people.append(
            Person(row.line, ids, tuple(f"{form}_{ids[0]}" for form in squeezed(name)), name, f"Canvas {ids[0]}")
        )
    return people


def squeezed(name: str) -> tuple[str, ...]:
    """Return a sortable name as Canvas puts it into file names, with and without letters that ASCII lacks.

    Examples
    --------
    >>> squeezed("O'Neill-Doe, Jane"), squeezed("Lu, Zoë")
    (('oneilldoejane',), ('luzoë', 'luzo'))
    """
    forms = (re.sub(r"[\W_]", "", name).lower(), re.sub(r"[^a-z0-9]", "", name.lower()))
    return tuple(dict.fromkeys(forms))


def _has_commas(possible: Row) -> bool:
    return any(re.fullmatch(r"\d+,\d+", cell.strip()) for cell in possible.values)
