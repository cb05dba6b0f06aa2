"""Rosters as spreadsheets write them, and what is wrong with those that cannot be used."""

from __future__ import annotations

import csv
import io
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.errors import UsageError
from autograder.problems.naming import Names
from autograder.problems.roster import Student, read_roster


def roster(tmp_path: Path, data: str | bytes) -> list[Student]:
    """Write a roster and read it."""
    path = tmp_path / "roster.csv"
    path.write_bytes(data if isinstance(data, bytes) else data.encode())
    return read_roster(path)


PLAIN = "student_id,name,email,section\ns1,Ann Lee,ann@x.edu,A\ns2,Bo,,B\n"
SAME = {
    "plain": PLAIN,
    "no last newline": PLAIN.rstrip("\n"),
    "Windows lines": PLAIN.replace("\n", "\r\n"),
    "old Mac lines": PLAIN.replace("\n", "\r"),
    "byte order mark": b"\xef\xbb\xbf" + PLAIN.encode(),
    "UTF-16": PLAIN.replace(",", "\t").encode("utf-16"),
    "semicolons": PLAIN.replace(",", ";"),
    "tabs": PLAIN.replace(",", "\t"),
    "stated separator": "sep=;\r\n" + PLAIN.replace(",", ";"),
    "quotes": '"student_id","name","email","section"\n"s1","Ann Lee","ann@x.edu","A"\n"s2","Bo","","B"\n',
    "blanks": "student_id , name , email , section\n s1 , Ann Lee , ann@x.edu , A \ns2,Bo,,B\n",
    "empty lines": "\n\n" + PLAIN.replace("\ns2", "\n\n,,,\ns2"),
    "empty columns at the end": PLAIN.replace("\n", ",,\n") + ",,,,,\n",
    "E-Mail": PLAIN.replace("email", "E-Mail"),
    "e-mail address": PLAIN.replace("email", "E-mail address"),
    "other headings": PLAIN.replace("student_id,name,email", "Student ID,NAME,E-mail").replace("E-mail", "Email"),
}


@pytest.mark.parametrize("data", SAME.values(), ids=SAME.keys())
def test_the_same_class_in_many_spellings(tmp_path: Path, data: str | bytes) -> None:
    """Separators, quotes, marks, blanks and empty lines make no difference."""
    first, second = roster(tmp_path, data)
    assert (first.student_id, first.name, first.email, dict(first.others)) == (
        "s1",
        "Ann Lee",
        "ann@x.edu",
        {"section": "A"},
    )
    assert (second.student_id, second.name, second.email) == ("s2", "Bo", "")


def test_only_the_id_is_needed(tmp_path: Path) -> None:
    """A column student_id is enough; a separator inside quotes is text."""
    assert roster(tmp_path, "student_id\ns1\n") == [Student("s1", line=2)]
    (student,) = roster(tmp_path, 'name,student_id\n"Lee, Ann; ""A""",s1\n')
    assert student.name == 'Lee, Ann; "A"'
    assert roster(tmp_path, '"a;b;c",student_id\nx,s1\n')[0].student_id == "s1"


def test_numbers_that_became_fractions_are_read(tmp_path: Path) -> None:
    """A whole number with .0 behind it is that number; an id with other signs in it stays as it is."""
    found = roster(tmp_path, "student_id\n20261001.0\n20261002,0\n".replace(",0", ".0") + "a7.0\nmarch-7\n")
    assert [student.student_id for student in found] == ["20261001", "20261002", "a7.0", "march-7"]


def test_a_handle_is_no_address(tmp_path: Path) -> None:
    """A handle in the place of the address is kept as it stands, and names nobody in a file's name."""
    students = roster(tmp_path, "student_id,name,email\ns1,Ann Lee,@ann:matrix.example\ns2,Bob Ray,b@example.edu\n")
    assert [student.email for student in students] == ["@ann:matrix.example", "b@example.edu"]
    assert Names(students).in_text("homework__final") == []


def test_lines_are_counted_as_an_editor_does(tmp_path: Path) -> None:
    """A name over two lines moves the following line numbers on."""
    students = roster(tmp_path, 'student_id,name\ns1,"Ann\nLee"\ns2,Bo\n')
    assert [student.line for student in students] == [2, 4]


def test_accents_are_composed(tmp_path: Path) -> None:
    """The two ways to write an accented letter are one id."""
    assert roster(tmp_path, "student_id\nZoe\u0308\n")[0].student_id == "Zo\u00eb"


BAD = {
    "duplicate": ("student_id\ns1\ns2\ns1\n", "line 4: student_id 's1' stands in line 2 already"),
    "duplicate but for capitals": ("student_id\ns1\nS1\n", "line 3: student_id 'S1' stands in line 2 already"),
    "empty id": ("student_id,name\ns1,Ann\n ,Bo\n", "line 3: student_id is empty"),
    "missing column": ("id,name\n1,Ann\n", "has no column student_id; expected it in the first line, got 'id', 'name'"),
    "no text": ("", "has no column student_id; expected it in the first line, got nothing"),
    "headings only": ("student_id,name\n", "has no students"),
    "too few columns": ("student_id,name,email\ns1,Ann\n", "line 2: it has 2 columns, expected 3"),
    "too many columns": ("student_id,name\ns1,Lee, Ann\n", "line 2: it has 3 columns, expected 2"),
    "column twice": ("student_id,name,name\n", "line 1: the column 'name' stands there twice"),
    "open quote": ('student_id,name\ns1,"Ann\ns2,Bo\n', "line 2: it is no proper CSV with commas: a quote opened"),
    "stray quote": ('student_id,name\ns1,"An"n\n', "line 2: it is no proper CSV with commas"),
    "path": ("student_id\n../s1\n", "line 2: student_id '../s1' cannot name a folder"),
    "slash": ("student_id\ns1\ns/1\n", "line 3: student_id 's/1' cannot name a folder"),
    "formula": ("student_id\n=1+1\n", "line 2: student_id '=1+1' cannot name a folder"),
    "too long": (f"student_id\n{'s' * 65}\n", "expected at most 64 letters"),
    "device": ("student_id\nCon\n", "line 2: student_id 'Con' cannot name a folder on every system"),
    "dot at the end": ("student_id\ns1.\n", "cannot name a folder on every system"),
    "spreadsheet number": ("student_id\n1.23457E+11\n", "is a number that a spreadsheet has shortened"),
    "a longer number": (
        "student_id,name\n1E+15,Ann\n2E+15,Bob\n",
        "'1E+15' is a number that a spreadsheet has shortened",
    ),
    "date": ("student_id\ns1\n12-Mar\n", "line 3: student_id '12-Mar' is an id that a spreadsheet has made a date of"),
    "date, other order": ("student_id\nMar-12\n", "has made a date of"),
    "whole number twice": ("student_id\n7\n7.0\n", "line 3: student_id '7' stands in line 2 already"),
    "other encoding": ("student_id,name\ns1,Müller\n".encode("latin-1"), "line 2: it is not UTF-8; save it as"),
    "zero byte": (b"student_id\ns1\ns\x002\n", "line 3: it holds a zero byte"),
    "a workbook": (b"PK\x03\x04\x14\x00\x06\x00\x08\x00\x00\x00!\x00\xb5\xd9", "line 1: it is not UTF-8"),
}


@pytest.mark.parametrize(("data", "words"), BAD.values(), ids=BAD.keys())
def test_what_cannot_be_used_is_named(tmp_path: Path, data: str | bytes, words: str) -> None:
    """The message says what came, where, and what was expected."""
    with pytest.raises(UsageError) as caught:
        roster(tmp_path, data)
    assert words in str(caught.value)


def test_a_missing_or_huge_roster_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A file that is not there, or far too large, is refused in a sentence."""
    with pytest.raises(UsageError, match="cannot be read"):
        read_roster(tmp_path / "none.csv")
    monkeypatch.setattr("autograder.problems.roster.LARGEST", 10)
    with pytest.raises(UsageError, match="is larger than 16 MiB"):
        roster(tmp_path, PLAIN)


CELLS = st.text(st.characters(codec="utf-8", exclude_characters="\0\r"), max_size=20)


@given(
    st.lists(CELLS, min_size=1, max_size=5),
    st.sampled_from(",;\t"),
    st.sampled_from([csv.QUOTE_ALL, csv.QUOTE_MINIMAL]),
)
def test_names_come_back_as_they_were_written(
    tmp_path_factory: pytest.TempPathFactory, names: list[str], separator: str, quoting: int
) -> None:
    """Whatever stands in a name, the row keeps its id and the name its text, but for outer blanks."""
    buffer = io.StringIO(newline="")
    writer = csv.writer(buffer, delimiter=separator, quoting=quoting)  # type: ignore[arg-type]  # wrong on purpose
    writer.writerow(["student_id", "name"])
    writer.writerows([f"s{k}", name] for k, name in enumerate(names))
    path = tmp_path_factory.mktemp("roster") / "roster.csv"
    path.write_text(buffer.getvalue(), encoding="utf-8", newline="")
    assert [(student.student_id, student.name) for student in read_roster(path)] == [
        (f"s{k}", name.strip()) for k, name in enumerate(names)
    ]
