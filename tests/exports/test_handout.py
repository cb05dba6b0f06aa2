"""A release is handed out: everybody gets their own file, and whoever cannot be told from others gets none."""

from __future__ import annotations

import csv
import io
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.errors import UsageError
from autograder.exports.bundle import bundle
from autograder.exports.handout import canvas_archive, mail_table, moodle_archive
from autograder.problems.roster import Student

SHEET = (
    'Identifier,"Full name","Email address",Status,Grade,"Maximum grade"\n'
    '"Participant 41","Jane Doe",Jane@uni.edu,-,,100.00\n'
    '"Participant 42","Jane Doe",jd2@uni.edu,-,,100.00\n'
    '"Participant 43","Zoë O\'Neill",zoe@uni.edu,-,,100.00\n'
).encode()
CLASS = [
    Student("s1", "Jane Doe", "jane@uni.edu"),
    Student("42", "Zoë O'Neill", "zoe@uni.edu"),
    Student("s3", "Jane Doe", "", {"moodle_id": "42"}),
    Student("43", "Max Moe", "max@uni.edu"),
]
ARCHIVES = {one.student_id: f"zip of {one.student_id}".encode() for one in CLASS}


def held(data: bytes) -> dict[str, bytes]:
    """Read an archive: content by name."""
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def test_moodle_is_given_everybodys_own_file() -> None:
    """By address or moodle_id, in the folder that Moodle knows the participant by; an id is no participant's number."""
    handed = moodle_archive(SHEET, "sheet.csv", CLASS, ARCHIVES)
    assert held(handed.data) == {
        "Jane Doe_41_assignsubmission_file_/s1.zip": b"zip of s1",
        "Zoë O'Neill_43_assignsubmission_file_/42.zip": b"zip of 42",
        "Jane Doe_42_assignsubmission_file_/s3.zip": b"zip of s3",
    }
    assert handed.notes == ("Not in sheet.csv with an address or moodle_id, so without a file: 43.",)


def test_moodle_is_given_nothing_where_two_share_a_line() -> None:
    """One address in two lines, or two students of one address."""
    twice = [*CLASS, Student("s9", "Jane", "JANE@uni.edu")]
    with pytest.raises(UsageError, match="s9 shares a line or an address"):
        moodle_archive(SHEET, "sheet.csv", twice, {**ARCHIVES, "s9": b""})
    with pytest.raises(UsageError, match="s1 shares a line or an address"):
        moodle_archive(SHEET.replace(b"jd2@", b"jane@"), "sheet.csv", CLASS, ARCHIVES)
    with pytest.raises(UsageError, match="fits nobody of the roster"):
        moodle_archive(SHEET, "sheet.csv", [Student("41", "Jane Doe")], {"41": b""})


def test_canvas_answers_the_zip_that_was_handed_in() -> None:
    """The newest one of each, where it is a .zip; a number that is not in the roster is nobody."""
    students = [Student(name, others={"canvas_id": number}) for name, number in (("a", "101"), ("b", "102"), ("c", ""))]
    uploads = ["doe_101_7_x.zip", "doe_101_9_y.zip", "ray_102_8_z.py", "sam_103_6_x.zip"]
    handed = canvas_archive(uploads, "submissions.zip", students, {"a": b"A", "b": b"B", "c": b"C"})
    assert held(handed.data) == {"doe_101_9_y.zip": b"A"}
    assert "without a file: b, c." in handed.notes[0]
    with pytest.raises(UsageError, match="column canvas_id"):
        canvas_archive(uploads, "submissions.zip", CLASS, ARCHIVES)


@given(st.lists(st.tuples(st.text(max_size=12), st.text(max_size=12)), max_size=4))
def test_a_mail_names_its_own_student_only(people: list[tuple[str, str]]) -> None:
    """A line each, that any CSV reader takes back; no cell begins a formula."""
    students = [Student(f"s{k}", name, email) for k, (name, email) in enumerate(people)]
    rows = list(csv.DictReader(io.StringIO(mail_table(students, "=SLAM", "Friday, 4 December"), newline="")))
    assert [row["attachment"] for row in rows] == [f"zips/s{k}.zip" for k in range(len(people))]
    assert all("until Friday, 4 December." in row["text"] for row in rows)
    assert [cell for row in rows for cell in row.values() if cell[:1] in {"=", "+", "-", "@"}] == []


def test_the_command_packs_a_release(run: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    """What it needs is named in one line; nothing is written where an archive is missing."""
    release, roster, sheet = tmp_path / "release", tmp_path / "class.csv", tmp_path / "sheet.csv"
    roster.write_text("student_id,email\ns1,jane@uni.edu\n")
    sheet.write_bytes(SHEET)
    told = ("export", "handout", release, "--roster", roster, "-o", tmp_path / "handout")
    assert "--worksheet (Moodle) or --submissions (Canvas)" in run(*told)[2]
    code, _, err = run(*told, "--worksheet", sheet)
    assert (code, "s1.zip cannot be read" in err) == (2, True)
    (release / "zips").mkdir(parents=True)
    (release / "zips" / "s1.zip").write_bytes(bundle({"s1/README.md": b"hello"}))
    assert run(*told, "--worksheet", sheet)[0] == 0
    packed = held((tmp_path / "handout" / "moodle.zip").read_bytes())
    assert list(packed) == ["Jane Doe_41_assignsubmission_file_/s1.zip"]
