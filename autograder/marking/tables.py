"""CSV files that people fill in: whatever a spreadsheet makes of them is read, with the line of every row."""

from __future__ import annotations

import codecs
import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from autograder.errors import UsageError

LARGEST = 64 << 20  # bytes
_SEPARATORS = ",;\t"
_MOST_SHOWN = 20


@dataclass(frozen=True)
class Row:
    """One row: its line in the file, and its cells by the names of the first row."""

    line: int
    cells: dict[str, str]

    def __getitem__(self, name: str) -> str:
        """Return a cell without blanks around it; "" where the row has none."""
        return self.cells.get(name, "").strip()


def read_table(path: Path, needed: Sequence[str]) -> list[Row]:
    """Read a table that has at least the columns `needed`.

    Commas, semicolons or tabs may stand between cells; UTF-8, UTF-16 with its mark, and what an old
    spreadsheet writes are read; capitals in the names of columns do not count; empty rows are left out.

    Raises
    ------
    UsageError
        Where the file cannot be read or lacks a column.
    """
    try:
        with path.open("rb") as file:
            data = file.read(LARGEST + 1)
    except OSError as error:
        raise UsageError(f"{path} cannot be read ({error.strerror}); expected a table with {listed(needed)}.") from None
    if len(data) > LARGEST:
        raise UsageError(f"{path} is larger than 64 MiB; expected a table with {listed(needed)}.")
    text = _text(data)
    first = text.lstrip("\n").partition("\n")[0]
    separator = max(_SEPARATORS, key=first.count)
    try:
        reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=False)
        names: list[str] = []
        rows = []
        begin = 1
        for cells in reader:
            if any(cell.strip() for cell in cells):
                if names:
                    rows.append(Row(begin, dict(zip(names, cells, strict=False))))
                else:
                    names = [cell.strip().casefold().replace(" ", "_") for cell in cells]
            begin = reader.line_num + 1
    except csv.Error as error:
        raise UsageError(f"{path}, line {begin}: is no table ({error}); export it as CSV again.") from None
    missing = [name for name in needed if name not in names]
    if missing:
        raise UsageError(f"{path} has no column {listed(missing)}; expected {listed(needed)} in the first row.")
    return rows


def number(text: str) -> float | None:
    """Read a number as people type it, with a point or a comma; None where it is none.

    Examples
    --------
    >>> number("1,5"), number("2"), number("two"), number("nan"), number("1e9")
    (1.5, 2.0, None, None, None)
    """
    plain = text.strip().replace(",", ".")
    digits = plain.removeprefix("+").removeprefix("-").replace(".", "", 1)
    return float(plain) if digits.isascii() and digits.isdecimal() and len(digits) < 13 else None


def refuse(path: Path, complaints: Sequence[tuple[int, str]]) -> None:
    """Raise UsageError with line and reason of every complaint, if there is one."""
    if complaints:
        told = " ".join(f"Line {line}: {reason}." for line, reason in complaints[:_MOST_SHOWN])
        more = f" And {len(complaints) - _MOST_SHOWN} more." if len(complaints) > _MOST_SHOWN else ""
        raise UsageError(f"{path} was not taken. {told}{more}")


def listed(names: Sequence[str]) -> str:
    """List names in words.

    Examples
    --------
    >>> listed(["a"]), listed(["a", "b", "c"])
    ('a', 'a, b and c')
    """
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


def _text(data: bytes) -> str:
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        text = data.decode("utf-16", "replace")
    else:
        try:
            text = data.decode("utf-8-sig")
        except UnicodeDecodeError:
            text = data.decode("cp1252", "replace")  # a spreadsheet of yesterday
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    first, _, rest = text.partition("\n")
    return "\n" + rest if first.strip().casefold().startswith("sep=") else text
