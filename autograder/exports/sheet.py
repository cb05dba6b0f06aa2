"""A CSV file in which single cells are changed and every other byte stays as it was."""

from __future__ import annotations

import codecs
import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from autograder.errors import UsageError

LARGEST = 64 * 2**20
_SEPARATORS = {",": "commas", ";": "semicolons", "\t": "tabs"}
_MARKS = ((codecs.BOM_UTF8, "utf-8"), (codecs.BOM_UTF16_LE, "utf-16-le"), (codecs.BOM_UTF16_BE, "utf-16-be"))
_STATED = re.compile(r'"?sep=([,;\t])"?(\r\n|\n|\r)', re.IGNORECASE)


@dataclass
class Row:
    """One row as it stands in the file: the cells with their quotes, and how the line ends."""

    cells: list[str]
    end: str
    line: int

    def __len__(self) -> int:
        return len(self.cells)

    def __getitem__(self, column: int) -> str:
        """Return the value of a cell, without quotes; "" beyond the end of the row."""
        return _value(self.cells[column]) if column < len(self.cells) else ""

    @property
    def values(self) -> list[str]:
        """The values of all cells."""
        return [_value(cell) for cell in self.cells]

    @property
    def blank(self) -> bool:
        """Whether nothing but blanks stands in it."""
        return not any(value.strip() for value in self.values)


@dataclass
class Sheet:
    """A table that is written back as it came.

    Parameters
    ----------
    name : str
        What messages call it.
    rows : list of Row
        All rows, the empty ones too.
    separator, mark, encoding, preamble
        How the file is written: between cells, byte order mark, encoding, and a first line `sep=;`.
    """

    name: str
    rows: list[Row]
    separator: str = ","
    mark: bytes = b""
    encoding: str = "utf-8"
    preamble: str = ""
    changed: int = field(default=0, compare=False)

    def write(self, row: Row, column: int, value: str) -> None:
        """Put a value into a cell, in quotes where the old one had them or the value needs them."""
        if row[column] == value:
            return
        quoted = row.cells[column].startswith('"') or any(sign in value for sign in ('"', "\r", "\n", self.separator))
        row.cells[column] = '"' + value.replace('"', '""') + '"' if quoted else value
        self.changed += 1

    def encode(self) -> bytes:
        """Return the bytes of the file."""
        text = "".join(self.separator.join(row.cells) + row.end for row in self.rows)
        return self.mark + (self.preamble + text).encode(self.encoding)

    def wrong(self, line: int, words: str) -> UsageError:
        """Make an error that names the file and the line."""
        return UsageError(f"{self.name}, line {line}: {words}.")


def read_sheet(data: bytes, name: str) -> Sheet:
    r"""Read a CSV file; commas, semicolons and tabs are told apart, byte order marks are understood.

    Raises
    ------
    UsageError
        Where it is no text, or a quote is never closed; with the line.

    Examples
    --------
    >>> sheet = read_sheet(b'\xef\xbb\xbfname;"mark"\r\n"Lee; Ann";\r\n', "marks.csv")
    >>> sheet.separator, sheet.rows[1].values
    (';', ['Lee; Ann', ''])
    >>> sheet.write(sheet.rows[1], 1, "87.5")
    >>> sheet.encode()
    b'\xef\xbb\xbfname;"mark"\r\n"Lee; Ann";87.5\r\n'
    """
    if len(data) > LARGEST:
        raise UsageError(f"{name} is larger than 64 MiB; expected the CSV file of one course.")
    mark, encoding = next((pair for pair in _MARKS if data.startswith(pair[0])), (b"", "utf-8"))
    try:
        text = data[len(mark) :].decode(encoding)
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise UsageError(f"{name}, line {line}: it is not UTF-8; export it again, or save it as 'CSV UTF-8'.") from None
    if "\0" in text:
        raise UsageError(f"{name} is no CSV file (it holds zero bytes); give the file as the system exported it.")
    stated = _STATED.match(text)
    preamble = stated[0] if stated else ""
    text = text[len(preamble) :]
    separator = stated[1] if stated else _separator(text)
    sheet = Sheet(name, [], separator, mark, encoding, preamble)
    sheet.rows.extend(_rows(sheet, text, 2 if preamble else 1))
    return sheet


def _separator(text: str) -> str:
    heading = next((line for line in text.splitlines() if line.strip()), "")
    bare = re.sub(r'"[^"]*"', "", heading)
    return max(_SEPARATORS, key=bare.count)


def _rows(sheet: Sheet, text: str, line: int) -> Iterator[Row]:
    """Cut the text into rows of cells; together they are the text again."""
    plain = re.compile(rf"[^{re.escape(sheet.separator)}\r\n]*")
    quoted = re.compile(r'"(?:[^"]|"")*"')
    at, cells, began = 0, [], line
    while at < len(text):
        if text[at] == '"':
            found = quoted.match(text, at)
            if found is None:
                raise sheet.wrong(line, "a quote opened there is never closed; export the file again")
        else:
            found = plain.match(text, at)
            assert found is not None  # it matches nothing at all, too
        cells.append(found[0])
        line += len(re.findall(r"\r\n|\n|\r", found[0]))
        at = found.end()
        following = text[at : at + 1]
        if following == sheet.separator:
            at += 1
            if at == len(text):
                cells.append("")
            continue
        if following not in {"", "\r", "\n"}:
            raise sheet.wrong(
                line, f"after a closing quote comes {following!r}; expected {_SEPARATORS[sheet.separator]}"
            )
        end = "\r\n" if text[at : at + 2] == "\r\n" else following
        yield Row(cells, end, began)
        at += len(end)
        line += bool(end)
        cells, began = [], line
    if cells:
        yield Row(cells, "", began)


def _value(cell: str) -> str:
    return cell[1:-1].replace('""', '"') if cell.startswith('"') else cell
