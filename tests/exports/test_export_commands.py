"""The commands of `autograder export` that carry marks: what they write, what they say, how they refuse."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from autograder.verdicts import Result
from tests.exports.test_canvas import GRADEBOOK
from tests.exports.test_canvas import imported as canvas_marks
from tests.exports.test_moodle import ENGLISH
from tests.exports.test_moodle import imported as moodle_marks
from tests.reports.examples import WRONG_J, result, stage

Run = Callable[..., tuple[int, str, str]]
Graded = Callable[[Sequence[Result]], Path]

CLASS = [
    result("doejane_101", stage("jacobian", "failed", None, "J is off", WRONG_J), student_id="101"),
    result("müllerzoë_103"),
    result("doejane_102"),
]


def test_canvas_in_and_out(run: Run, graded: Graded, tmp_path: Path) -> None:
    """The gradebook and the feedback archive are written, and what was left alone is said."""
    gradebook, uploads = tmp_path / "g.csv", tmp_path / "submissions.zip"
    gradebook.write_bytes(GRADEBOOK)
    with zipfile.ZipFile(uploads, "w") as archive:
        archive.writestr("doejane_101_2001_slam1d.py", "pass")
    code, out, err = run(
        "export", "canvas", graded(CLASS), "--gradebook", gradebook, "--assignment", "1D SLAM",
        "--submissions", uploads, "-o", tmp_path / "new",
    )  # fmt: skip
    assert (code, out) == (0, "")
    assert canvas_marks((tmp_path / "new" / "gradebook.csv").read_bytes())["101"] == "75"
    with zipfile.ZipFile(tmp_path / "new" / "feedback.zip") as archive:
        (name,) = archive.namelist()
        said = archive.read(name).decode()
    assert name == "doejane_101_2001_slam1d.py"
    assert "J is off" in said
    assert "zoë" not in said
    assert "Excused in Canvas: Müller, Zoë" in err


def test_moodle_in_and_out(run: Run, graded: Graded, tmp_path: Path) -> None:
    """The worksheet is filled in, and everybody's page lies in the student's own folder."""
    sheet = tmp_path / "w.csv"
    sheet.write_bytes(ENGLISH)
    results = [result("Jane Doe_41"), result("Jane Doe_42"), result("stranger")]
    code, _, err = run("export", "moodle", graded(results), "--worksheet", sheet, "--comments", "-o", tmp_path / "new")
    assert code == 0
    assert moodle_marks((tmp_path / "new" / "worksheet.csv").read_bytes(), "en") == {"41": "90", "42": "90", "43": ""}
    with zipfile.ZipFile(tmp_path / "new" / "feedback.zip") as archive:
        pages = {name: archive.read(name).decode() for name in archive.namelist()}
    assert sorted(pages) == [f"Jane Doe_{number}_assignsubmission_file_/feedback.html" for number in (41, 42)]
    for name, page in pages.items():
        other = "41" if "_42_" in name else "42"
        assert f"Doe_{other}" not in page
    assert "stranger" in err


def test_mailmerge_writes_a_table(run: Run, graded: Graded, tmp_path: Path) -> None:
    """One file, one line a student."""
    roster = tmp_path / "class.csv"
    roster.write_text("student_id,name,email\n101,Jane Doe,jane@uni.edu\n", encoding="utf-8")
    code, _, err = run("export", "mailmerge", graded(CLASS), "--roster", roster, "-o", tmp_path / "mail.csv")
    assert code == 0
    assert "jane@uni.edu" in (tmp_path / "mail.csv").read_text(encoding="utf-8")
    assert "müllerzoë_103" in err


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("canvas", "--gradebook", "missing.csv", "-o", "new"), "missing.csv cannot be read (No such file"),
        (("canvas", "--gradebook", "g.csv", "--is", "ann", "-o", "new"), "expected UPLOAD=ID"),
        (("canvas", "--gradebook", "g.csv", "--assignment", "77", "--is", "ann=1", "-o", "new"), "no such submission"),
        (("canvas", "--gradebook", "g.csv", "--assignment", "77", "--is", "doejane_102=9", "-o", "new"), "the id '9'"),
        (
            ("canvas", "--gradebook", "g.csv", "--assignment", "77", "--submissions", "cut.zip", "-o", "new"),
            "cut.zip is no whole zip archive",
        ),
        (("moodle", "--worksheet", "g.csv", "-o", "new"), "no column that is known as the grade"),
        (("moodle", "--worksheet", "w.csv", "--grade-column", "Mark", "-o", "new"), "has 0 columns 'Mark'"),
        (("mailmerge", "--roster", "g.csv", "-o", "mail.csv"), "no column student_id"),
        (("mailmerge", "-o", "no/such/mail.csv"), "could not be written"),
    ],
)  # fmt: skip
def test_bad_input_is_one_sentence_and_nothing_is_written(
    run: Run, graded: Graded, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, arguments: tuple[str, ...], words: str
) -> None:
    """The exit code is 2, stderr one line, and there is no new file."""
    out = graded(CLASS)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "g.csv").write_bytes(GRADEBOOK)
    (tmp_path / "w.csv").write_bytes(ENGLISH)
    (tmp_path / "cut.zip").write_bytes(b"PK\x03\x04 and no more")
    system, *rest = arguments
    before = sorted(tmp_path.rglob("*"))
    code, stdout, err = run("export", system, out, *rest)
    assert (code, stdout) == (2, "")
    assert words in err
    assert len(re.findall("^autograder: ", err, re.MULTILINE)) == 1
    assert sorted(tmp_path.rglob("*")) == before


def test_what_people_decided_is_exported(run: Run, graded: Graded, tmp_path: Path) -> None:
    """An override counts in the marks and stands in the feedback, without another report."""
    out = graded(CLASS)
    (out / "overrides.csv").write_text(
        "student,stage,points,reason,who,when\ndoejane_101,jacobian,9,shown at the board,TA,2026-03-02\n",
        encoding="utf-8",
    )
    (tmp_path / "g.csv").write_bytes(GRADEBOOK)
    arguments = ("--gradebook", tmp_path / "g.csv", "--assignment", "77", "--any-maximum", "-o", tmp_path / "new")
    assert run("export", "canvas", out, *arguments)[0] == 0
    assert canvas_marks((tmp_path / "new" / "gradebook.csv").read_bytes())["101"] == "84"
    assert run("export", "mailmerge", out, "-o", tmp_path / "mail.csv")[0] == 0
    assert "shown at the board" in (tmp_path / "mail.csv").read_text(encoding="utf-8")


def test_an_unknown_system_is_named(run: Run) -> None:
    """The systems that there are stand in the message."""
    code, _, err = run("export", "blackboard")
    assert code == 2
    assert "canvas, " in err
