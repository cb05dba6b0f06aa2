"""The pages for instructors, graders and students tell the truth: every command in them is run, in its order."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from autograder import cli
from autograder.course import load_course
from autograder.course.schema import KEYS
from autograder.desk.server import Desk
from autograder.marking.overrides import read_overrides

ROOT = Path(__file__).resolve().parent.parent
DOCS = ROOT / "docs"
PAGES = ("instructor.md", "deadline-night.md", "students.md")


def commands(page: str) -> list[str]:
    """List the lines of every block of commands of a page."""
    blocks = re.findall(r"^```sh\n(.*?)^```$", (DOCS / page).read_text("utf-8"), flags=re.MULTILINE | re.DOTALL)
    return [line for block in blocks for line in block.splitlines() if line.strip()]


def named(page: str) -> list[str]:
    """List the commands that stand inside of sentences."""
    return re.findall(r"`(autograder [a-z][^`]*)`", (DOCS / page).read_text("utf-8"))


@pytest.fixture
def desk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with uploads, a course file and what is left of yesterday; nobody sits at the browser."""
    (tmp_path / "uploads").mkdir()
    shutil.copyfile(ROOT / "reference_solution" / "slam1d.py", tmp_path / "uploads" / "ada.py")
    (tmp_path / "uploads" / "bob.py").write_text("def residual(x, graph):\n    return x\nwritten_3 = 'f is affine.'\n")
    (tmp_path / "course.toml").write_text("[grading]\nexamples = 10\n")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(Desk, "serve_forever", lambda *_: (_ for _ in ()).throw(KeyboardInterrupt))
    monkeypatch.setattr("webbrowser.open", lambda _: True)
    return tmp_path


def run(line: str, capsys: pytest.CaptureFixture[str]) -> str:
    """Run one line of a page; it must end well."""
    program, *arguments = line.split()
    assert program == "autograder", line
    with pytest.raises(SystemExit) as end:
        cli.main(arguments)
    out, err = capsys.readouterr()
    assert end.value.code == 0, f"{line}: {err}"
    return out + err


@pytest.mark.slow
@pytest.mark.parametrize("page", PAGES[:2])
def test_every_command_of_a_page_works_in_its_order(page: str, desk: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """In a folder as the page describes it, each line ends with exit code 0."""
    lines = commands(page)
    assert len(lines) >= 4
    for line in lines:
        if line.startswith("autograder init"):
            (desk / "course.toml").unlink()
        if line.startswith("autograder diff"):
            shutil.copytree(desk / "graded", desk / "graded-before")
        run(line, capsys)
        if line.startswith("autograder init"):
            text = (desk / "course.toml").read_text()
            (desk / "course.toml").write_text(text.replace("examples = 200", "examples = 10"))
            assert load_course(desk / "course.toml").examples == 10


@pytest.mark.parametrize("page", PAGES)
def test_a_command_in_a_sentence_exists_with_its_options(page: str) -> None:
    """Its name and every option of it are known."""
    for line in named(page):
        name, *arguments = line.split()[1:]
        command = cli.cli.get_command(None, name)  # type: ignore[arg-type] - the context is not looked at
        assert command is not None, line
        known = {option for parameter in command.params for option in parameter.opts}
        assert {word for word in arguments if word.startswith("-")} <= known, line


def test_the_students_command_works(tmp_path: Path) -> None:
    """In a student's folder, with a finished submission in it."""
    assert commands("students.md") == ["python self_check.py"]
    for name in ("self_check.py", "posegraph.py"):
        shutil.copyfile(ROOT / "assignment" / name, tmp_path / name)
    shutil.copyfile(ROOT / "reference_solution" / "slam1d.py", tmp_path / "slam1d.py")
    done = subprocess.run(
        [sys.executable, "self_check.py"], cwd=tmp_path, capture_output=True, text=True, check=False, timeout=120
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_override_of_the_page_is_one(tmp_path: Path) -> None:
    """The example can be copied as it stands."""
    [block] = re.findall(
        r"^```text\n(student,.*?)^```$", (DOCS / PAGES[0]).read_text("utf-8"), re.MULTILINE | re.DOTALL
    )
    (tmp_path / "overrides.csv").write_text(block, encoding="utf-8")
    [override] = read_overrides(tmp_path)
    assert (override.student, override.stage, override.points) == ("ada", "residual", 15.0)


@pytest.mark.parametrize("page", PAGES)
def test_every_link_leads_somewhere(page: str) -> None:
    """A link is a file of ours."""
    links = re.findall(r"\]\(([^)#]+)\)", (DOCS / page).read_text("utf-8"))
    assert [link for link in links if not (DOCS / link).exists()] == []


def test_what_the_pages_say_of_settings_exists() -> None:
    """Sections and keys that are named are those of the course file."""
    text = "".join((DOCS / page).read_text("utf-8") for page in PAGES)
    assert set(re.findall(r"`\[(\w+)\]", text)) <= set(KEYS)
