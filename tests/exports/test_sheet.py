"""A table is written back byte for byte, and only what was changed has changed."""

from __future__ import annotations

import csv
import io

import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.errors import UsageError
from autograder.exports.sheet import read_sheet

CELLS = st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\0"), max_size=8)
TABLES = st.integers(2, 4).flatmap(
    lambda width: st.lists(st.lists(CELLS, min_size=width, max_size=width), min_size=1, max_size=5)
)
MARKS = {"plain": b"", "utf-8": b"\xef\xbb\xbf"}


def written(rows: list[list[str]], separator: str, ending: str, quoting: int) -> str:
    """Write a table as other programs do; the headings are plain words, as those of the systems are."""
    file = io.StringIO()
    writer = csv.writer(file, delimiter=separator, lineterminator=ending, quoting=quoting)
    writer.writerow([f"column {number}" for number in range(len(rows[0]))])
    writer.writerows(rows)
    return file.getvalue()


@given(
    TABLES,
    st.sampled_from([",", ";", "\t"]),
    st.sampled_from(["\n", "\r\n"]),
    st.sampled_from([csv.QUOTE_MINIMAL, csv.QUOTE_ALL]),
    st.sampled_from(sorted(MARKS)),
    st.booleans(),
)
def test_what_is_not_changed_stays(
    rows: list[list[str]], separator: str, ending: str, quoting: int, mark: str, cut: bool
) -> None:
    """Reading and writing gives the same bytes, and the cells are those that Python reads."""
    text = written(rows, separator, ending, quoting)
    text = text.removesuffix(ending) if cut else text
    data = MARKS[mark] + text.encode()
    sheet = read_sheet(data, "t.csv")
    assert sheet.encode() == data
    assert sheet.separator == separator
    expected = list(csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True))
    assert [row.values for row in sheet.rows if row.values != [""]] == [
        row for row in expected if row not in ([], [""])
    ]


@given(TABLES, CELLS, st.data())
def test_one_cell_changes_alone(rows: list[list[str]], value: str, data: st.DataObject) -> None:
    """A cell that is written reads as written, and every other cell as before."""
    sheet = read_sheet(written(rows, ",", "\r\n", csv.QUOTE_MINIMAL).encode(), "t.csv")
    row = data.draw(st.integers(0, len(rows) - 1))
    column = data.draw(st.integers(0, len(rows[0]) - 1))
    sheet.write(sheet.rows[row + 1], column, value)
    again = [found.values for found in read_sheet(sheet.encode(), "t.csv").rows[1:]]
    wanted = [list(cells) for cells in rows]
    wanted[row][column] = value
    assert again == wanted


def test_utf_16_and_a_stated_separator_are_kept() -> None:
    """What spreadsheets add is understood and written back."""
    text = 'sep=;\r\na;b\r\n1;"2;3"\r\n'
    for data in (b"\xff\xfe" + text.encode("utf-16-le"), b"\xfe\xff" + text.encode("utf-16-be")):
        sheet = read_sheet(data, "t.csv")
        assert [row.values for row in sheet.rows] == [["a", "b"], ["1", "2;3"]]
        assert sheet.encode() == data


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b'a,b\n1,"2\n3,4\n', "t.csv, line 2: a quote opened there is never closed"),
        (b'a,b\n"1"2,3\n', "t.csv, line 2: after a closing quote comes '2'"),
        (b"a,b\nM\xfcller,1\n", "t.csv, line 2: it is not UTF-8"),
        (b"PK\x03\x04\0\0", "t.csv is no CSV file"),
    ],
)
def test_a_damaged_file_is_named_with_its_line(data: bytes, words: str) -> None:
    """What cannot be read ends in one sentence."""
    with pytest.raises(UsageError) as error:
        read_sheet(data, "t.csv")
    assert words in str(error.value)
