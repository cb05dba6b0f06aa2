"""The page on other systems is true: its commands are run as they stand there, on what these systems hand over."""

from __future__ import annotations

import csv
import re
import shlex
from pathlib import Path

import pytest

from autograder import cli
from autograder.engine.exam import draw_exam, save_exam
from autograder.problems.families import family
from autograder.problems.ledger import Ledger, write_ledger
from autograder.problems.secret import Secret
from tests.intake.making import archive

ROOT = Path(__file__).parent.parent
PAGE = (ROOT / "docs/interop.md").read_text("utf-8")
SOLVED = (ROOT / "reference_solution/slam1d.py").read_text("utf-8")
CANVAS = "Student,ID,SIS User ID,Section,1D SLAM (7)\n    Points Possible,,,,100\n"
MOODLE = 'Identifier,"Full name",Grade,"Maximum grade"\n'


def commands(title: str) -> list[list[str]]:
    """List the commands of this program in one section, in its order: lines of blocks and those in sentences."""
    section = PAGE.partition(f"\n## {title}\n")[2].partition("\n## ")[0]
    found = re.findall(r"^(autograder [^#\n]*)|`(autograder [a-z][^`]*)`", section, flags=re.MULTILINE)
    return [shlex.split(line or sentence) for line, sentence in found]


def run(words: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    """Run one command; it must end well."""
    with pytest.raises(SystemExit) as end:
        cli.main(words[1:])
    out, err = capsys.readouterr()
    assert end.value.code == 0, f"{words}: {err}"
    return out + err


@pytest.fixture
def desk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with roster, course and release; a small exam lies there already, so that nothing takes long."""
    (tmp_path / "graded").mkdir()
    save_exam(draw_exam(0, 2), tmp_path / "graded/exam")
    (tmp_path / "class.csv").write_text("student_id,name,email\ns1001,Jane Doe,jane@x.edu\ns1002,John Roe,john@x.edu\n")
    (tmp_path / "course.toml").write_text("[grading]\nexamples = 2\n")
    (tmp_path / "release/staff").mkdir(parents=True)
    ledger = Ledger()
    ledger.extend(Secret(b"0123456789abcdef"), "2026S", {"s1001": family("A"), "s1002": family("A")})
    write_ledger(tmp_path / "release/staff/variants.csv", ledger)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.slow
def test_canvas(desk: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Marks go to the line of the number in the download, and the feedback under the name of the upload."""
    (desk / "submissions.zip").write_bytes(archive({"doejane_101_9001_slam1d.py": SOLVED}))
    (desk / "grades.csv").write_text(f'{CANVAS}"Doe, Jane",101,s1001,A,\n"Roe, John",102,s1002,A,\n')
    grade, export = commands("Canvas")
    run(grade, capsys)
    assert "Without a result: Roe, John" in run(export, capsys)
    rows = list(csv.DictReader((desk / "canvas/gradebook.csv").read_text().splitlines()))
    assert [row["1D SLAM (7)"] for row in rows] == ["100", "100", ""]
    assert (desk / "canvas/feedback.zip").exists()
    decide = commands("Who is who")[0]
    assert "--is" in decide
    run(decide, capsys)
    assert "doejane_101,s1001" in (desk / "graded/owners.csv").read_text()
    (mail,) = commands("Mail merge")
    run(mail, capsys)
    (row,) = csv.DictReader((desk / "mail.csv").read_text("utf-8-sig").splitlines())
    assert (row["student_id"], row["email"]) == ("s1001", "jane@x.edu")
    assert (desk / "graded" / row["page"]).is_file()


@pytest.mark.slow
def test_moodle(desk: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Marks go to the line of the participant's number."""
    (desk / "submissions.zip").write_bytes(archive({"Jane Doe_42_assignsubmission_file_/slam1d.py": SOLVED}))
    (desk / "sheet.csv").write_text(f'{MOODLE}"Participant 41",Jane Doe,,100.00\n"Participant 42",Jane Doe,,100.00\n')
    for words in commands("Moodle"):
        run(words, capsys)
    rows = list(csv.DictReader((desk / "moodle/worksheet.csv").read_text().splitlines()))
    assert [row["Grade"] for row in rows] == ["", "100"]
    assert (desk / "moodle/feedback.zip").exists()


@pytest.mark.slow
@pytest.mark.parametrize("system", ["Gradescope", "nbgrader", "Otter"])
def test_what_is_made_for_other_graders(system: str, desk: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Each line of this program ends well, one after the other, with what the other program would leave there."""
    lines = [words for words in commands(system) if words[1:] != ["grade"]]
    assert lines
    for words in lines:
        if "slam-course/submitted" in words:
            (desk / "slam-course/submitted/s1001/slam1d").mkdir(parents=True)
            (desk / "slam-course/submitted/s1001/slam1d/slam1d.py").write_text(SOLVED)
        run(words, capsys)


def test_every_command_in_a_sentence_is_known() -> None:
    """Whatever stands in the page as a command exists with its options."""
    for line in re.findall(r"`(autograder [a-z][^`]*)`", PAGE):
        name, *arguments = shlex.split(line)[1:]
        command = cli.cli.get_command(None, name)  # type: ignore[arg-type] - the context is not looked at
        assert command is not None, line
        if name == "export" and arguments:
            command = command.get_command(None, arguments[0])  # type: ignore[attr-defined] - a group of commands
        known = {option for parameter in command.params for option in parameter.opts}
        assert {word for word in arguments if word.startswith("-")} <= known, line
