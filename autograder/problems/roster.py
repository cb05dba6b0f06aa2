"""The roster: a class as a CSV file, read with patience for spreadsheets and none for doubt."""

from __future__ import annotations

import csv
import io
import re
import unicodedata
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from autograder.errors import UsageError

__all__ = ["Student", "normal_id", "read_roster"]

LARGEST = 16 * 2**20
SEPARATORS = {",": "commas", ";": "semicolons", "\t": "tabs"}
_ID = re.compile(r"\w[\w .@+-]{0,63}")
_RESERVED = re.compile(r"(con|prn|aux|nul|com\d|lpt\d)(\..*)?", re.IGNORECASE)
_SHORTENED = re.compile(r"\d([.,]\d+)?E\+\d+", re.IGNORECASE)
_MONTHS = "jan|feb|mar|mär|mrz|apr|may|mai|jun|jul|aug|sep|sept|oct|okt|nov|dec|dez"
_DATED = re.compile(rf"\d{{1,2}}[-. ]+({_MONTHS})|({_MONTHS})[-. ]+\d{{1,4}}", re.IGNORECASE)
_WHOLE = re.compile(r"(\d+)[.,]0")  # 20261001.0: a column that became numbers on its way
_COLUMNS = {"e_mail": "email", "email_address": "email", "e_mail_address": "email", "studentid": "student_id"}


@dataclass(frozen=True)
class Student:
    """One line of the roster.

    Parameters
    ----------
    student_id : str
        Letters, digits and . _ - @ + and blanks; it names the student's folder.
    name, email : str
        "" where the roster has no such column.
    others : mapping
        The other columns as they stand: heading -> text.
    line : int
        Where in the file it stands.
    """

    student_id: str
    name: str = ""
    email: str = ""
    others: Mapping[str, str] = field(default_factory=dict, hash=False)
    line: int = 0


def normal_id(text: str) -> str:
    """Bring an id to the one form in which ids are stored and compared: no outer blanks, composed accents."""
    return unicodedata.normalize("NFC", text.strip())


def read_roster(path: Path) -> list[Student]:
    """Read a class from a CSV file with a column student_id and, if wanted, name, email and others.

    Commas, semicolons or tabs separate; quotes, a byte order mark and a first line `sep=;` are
    understood; empty lines are skipped.

    Raises
    ------
    UsageError
        Where the file cannot be read, has no column student_id, or an id is empty, unusable or
        there twice; with the line.
    """
    try:
        with path.open("rb") as file:
            data = file.read(LARGEST + 1)
    except OSError as error:
        raise UsageError(f"Roster {path} cannot be read ({error.strerror}); expected a CSV file.") from None
    if len(data) > LARGEST:
        raise UsageError(f"Roster {path} is larger than 16 MiB; expected a CSV file with a line for every student.")
    lines = _rows(path, _decoded(path, data))
    _, header = next(lines, (1, []))
    columns = _columns(path, header)
    students: list[Student] = []
    seen: dict[str, int] = {}
    for line, row in lines:
        while len(row) > len(header) and not row[-1].strip():
            row.pop()
        if len(row) != len(header):
            raise _error(path, line, f"it has {len(row)} columns, expected {len(header)} as in the first line")
        cells = dict(zip(columns, (cell.strip() for cell in row), strict=True))
        cells.pop("", None)  # a column that nobody has named
        student_id = normal_id(cells.pop("student_id"))
        student_id = whole[1] if (whole := _WHOLE.fullmatch(student_id)) else student_id
        trouble = _trouble(student_id)
        if trouble:
            raise _error(path, line, trouble)
        fold = student_id.casefold()
        if fold in seen:
            raise _error(path, line, f"student_id {student_id!r} stands in line {seen[fold]} already; expected it once")
        seen[fold] = line
        students.append(Student(student_id, cells.pop("name", ""), cells.pop("email", ""), cells, line))
    if not students:
        raise UsageError(f"Roster {path} has no students; expected a line for each below the headings.")
    return students


def _error(path: Path, line: int, words: str) -> UsageError:
    return UsageError(f"Roster {path}, line {line}: {words}.")


def _decoded(path: Path, data: bytes) -> str:
    encoding = "utf-16" if data[:2] in {b"\xff\xfe", b"\xfe\xff"} else "utf-8-sig"
    try:
        text = data.decode(encoding)
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise _error(path, line, "it is not UTF-8; save it as 'CSV UTF-8'") from None
    if "\0" in text:
        raise _error(path, text.count("\n", 0, text.index("\0")) + 1, "it holds a zero byte; save it as 'CSV UTF-8'")
    return text


def _rows(path: Path, text: str) -> Iterator[tuple[int, list[str]]]:
    """Split the text into rows, each with the number of the line where it begins."""
    first, _, rest = text.partition("\n")
    skipped = 0
    stated = re.fullmatch(r"\"?sep=([,;\t])\"?\s*", first, re.IGNORECASE)
    if stated:
        separator, text, skipped = stated[1], rest, 1
    else:
        heading = next((line for line in text.splitlines() if line.strip()), "")
        bare = re.sub(r'"[^"]*"', "", heading)
        separator = max(SEPARATORS, key=bare.count)
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True)
    line = skipped + 1
    while True:
        try:
            row = next(reader)
        except StopIteration:
            return
        except csv.Error as error:
            words = "a quote opened there is never closed" if "end of data" in str(error) else str(error)
            raise _error(path, line, f"it is no proper CSV with {SEPARATORS[separator]}: {words}") from None
        if any(cell.strip() for cell in row):
            yield line, row
        line = skipped + reader.line_num + 1


def _columns(path: Path, header: list[str]) -> list[str]:
    """Name the columns: ours in their plain form, others as they stand."""
    plain = [re.sub(r"[\s_-]+", "_", cell.strip()).casefold() for cell in header]
    names = [
        key if key in {"student_id", "name", "email"} else cell.strip()
        for key, cell in zip((_COLUMNS.get(key, key) for key in plain), header, strict=True)
    ]
    if "student_id" not in names:
        shown = ", ".join(map(repr, names)) if names else "nothing"
        raise UsageError(f"Roster {path} has no column student_id; expected it in the first line, got {shown}.")
    twice = [name for name in names if name and names.count(name) > 1]
    if twice:
        raise _error(path, 1, f"the column {twice[0]!r} stands there twice; expected each once")
    return names


def _trouble(student_id: str) -> str:
    """Say what is wrong with an id; "" where nothing is."""
    if not student_id:
        return "student_id is empty; expected an id, or no line at all"
    if _SHORTENED.fullmatch(student_id):
        return f"student_id {student_id!r} is a number that a spreadsheet has shortened; format the column as text"
    if _DATED.fullmatch(student_id):
        return f"student_id {student_id!r} is an id that a spreadsheet has made a date of; format the column as text"
    if not _ID.fullmatch(student_id):
        return (
            f"student_id {student_id!r} cannot name a folder; "
            "expected at most 64 letters, digits and . _ - @ + or blanks, beginning with a letter or digit"
        )
    if student_id.endswith(".") or _RESERVED.fullmatch(student_id):
        return f"student_id {student_id!r} cannot name a folder on every system; expected another"
    return ""
