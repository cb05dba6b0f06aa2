"""The sheet of written answers goes out empty, comes back from any spreadsheet, and is checked line by line."""

from __future__ import annotations

import csv
import io
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.course import Course
from autograder.errors import UsageError
from autograder.marking.anonymous import anonymous_names, read_key
from autograder.marking.answers import answers
from autograder.marking.marks import Mark, read_marks, write_marks
from autograder.marking.sheet import COLUMNS, read_sheet, sheet_text, unread
from autograder.marking.spreadsheets import bare, cell
from tests.marking.written import written_class

ALL = answers(written_class(), {}, Course())
KEYS = [("ann", "2"), ("eve", "2"), ("ann", "3"), ("bob", "3"), ("eve", "3")]


def sheet(folder: Path, *rows: str, head: str = "submission,question,points,comment") -> Path:
    """Write a sheet by hand."""
    path = folder / "filled.csv"
    path.write_text("\n".join([head, *rows]) + "\n", encoding="utf-8")
    return path


def refused(path: Path) -> str:
    """Return why a sheet is not taken."""
    with pytest.raises(UsageError) as error:
        read_sheet(path, ALL)
    return str(error.value)


def test_every_answer_with_words_has_a_row_with_empty_points_and_comment() -> None:
    """By question, then by name; nothing in it is a formula."""
    rows = list(csv.DictReader(io.StringIO(sheet_text(ALL))))
    assert [(row["submission"], row["question"]) for row in rows] == KEYS
    assert {row["points"] + row["comment"] for row in rows} == {""}
    assert {row["max_points"] for row in rows} == {"2", "3"}
    assert rows[3]["answer"].startswith("'=cmd|")
    assert list(rows[0]) == list(COLUMNS)


@pytest.mark.parametrize("separator", [",", ";", "\t"])
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
def test_a_sheet_comes_back_from_any_spreadsheet(tmp_path: Path, separator: str, encoding: str) -> None:
    """Separators, encodings, decimal commas and line ends differ; the marks do not."""
    file = io.StringIO(newline="")
    writer = csv.writer(file, delimiter=separator, lineterminator="\r\n")
    writer.writerow(["Submission", "Question", "Points", "Comment"])
    writer.writerow(["ann", "2", "1,5", "schön,\r\nzwei Zeilen; ja"])
    writer.writerow(["", "", "", ""])
    writer.writerow(["bob", "3", "3.0", ""])
    path = tmp_path / "filled.csv"
    path.write_bytes(file.getvalue().encode(encoding))
    found = read_sheet(path, ALL)
    assert [(mark.key, mark.points, mark.of) for mark in found.marks] == [
        (("ann", "2"), 1.5, 2.0),
        (("bob", "3"), 3.0, 3.0),
    ]
    assert found.marks[0].comment.startswith("schön,")


@pytest.mark.parametrize(
    ("row", "words"),
    [
        ("anna,2,1,", "Line 2: there is no written answer of 'anna'; did you mean ann"),
        ("bob,2,1,", "Line 2: bob has no answer to question '2'"),
        ("ann,2,2.5,", "Line 2: 2.5 points, but question 2 has 2"),
        ("ann,2,-1,", "Line 2: -1 points"),
        ("ann,2,good,", "Line 2: points are 'good', expected a number from 0 to 2"),
        ("ann,2,nan,", "Line 2: points are 'nan'"),
        ("ann,2,1e9,", "Line 2: points are '1e9'"),
        ("ann,2,,well done", "Line 2: a comment without points"),
        ("ann,2,1,\nann,2,2,", "Line 3: differs from line 2"),
        ('ann,2,1,"two\nlines"\nann,7,1,', "Line 4: ann has no answer to question '7'"),
    ],
)
def test_a_row_that_cannot_be_taken_is_named_with_its_line(tmp_path: Path, row: str, words: str) -> None:
    """And nothing of the sheet is stored."""
    assert words in refused(sheet(tmp_path, row))


def test_rows_without_points_are_named_and_wait(tmp_path: Path) -> None:
    """Half a pile may be taken."""
    found = read_sheet(sheet(tmp_path, "ann,2,1,", "ann,3,,"), ALL)
    assert len(found.marks) == 1
    assert found.empty == ((3, "no points for question 3 of ann"),)


def test_a_sheet_without_its_columns_or_without_a_file_is_refused(tmp_path: Path) -> None:
    """What is missing is named."""
    assert "has no column points" in refused(sheet(tmp_path, "ann,2", head="submission,question"))
    assert "cannot be read" in refused(tmp_path / "none.csv")


def test_anonymous_names_say_nothing_stay_and_come_back(tmp_path: Path) -> None:
    """A second call gives the same names; a filled anonymous sheet finds its students."""
    names = anonymous_names(tmp_path, ["ann", "bob"])
    more = anonymous_names(tmp_path, ["ann", "bob", "eve", "sam"])
    assert {name: more[name] for name in names} == names
    assert len(set(more.values())) == 4
    listed = answers(written_class(), {}, Course(), more)
    assert "ann" not in sheet_text(listed)
    path = sheet(tmp_path, f"{more['ann']},2,1,")
    assert read_sheet(path, ALL, read_key(tmp_path)).marks[0].key == ("ann", "2")


def test_marks_are_written_sorted_and_read_back(tmp_path: Path) -> None:
    """Whatever a name or a comment begins with; the same marks give the same bytes."""
    given = [Mark("=b", "3", 1.0, 3.0, "@x", "d"), Mark("a", "2", 0.5, 2.0, 'two\n"lines"', "d")]
    write_marks(tmp_path, given)
    before = (tmp_path / "marks.csv").read_bytes()
    assert set(read_marks(tmp_path).values()) == set(given)
    write_marks(tmp_path, reversed(given))
    assert (tmp_path / "marks.csv").read_bytes() == before


def test_a_damaged_marks_file_is_refused_with_its_line(tmp_path: Path) -> None:
    """Marks are never dropped in silence."""
    (tmp_path / "marks.csv").write_text("submission,question,points,of\na,2,x,2\n")
    with pytest.raises(UsageError, match="Line 2: points are 'x'"):
        read_marks(tmp_path)


def test_a_sheet_with_marks_that_nobody_took_is_seen(tmp_path: Path) -> None:
    """It must not be written over; a sheet as it went out may be."""
    path = tmp_path / "written.csv"
    path.write_text(sheet_text(ALL))
    assert not unread(path, ALL)
    path.write_text(sheet_text(ALL).replace("is *zero*: $x^{(2)} = x^{(1)}$.,,", "zero,2,"))
    assert unread(path, ALL)


@given(st.text(max_size=30))
def test_a_cell_is_never_a_formula_and_comes_back(text: str) -> None:
    """But for control characters, which become blanks."""
    shown = cell(text)
    assert not shown.lstrip().startswith(("=", "+", "-", "@"))
    if shown in (text, "'" + text):
        assert bare(shown) == text
