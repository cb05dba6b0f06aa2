"""The examples of docs/interop.md do what the page says: their commands run, their files have the right shape."""

from __future__ import annotations

import json
import re
import runpy
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path
from typing import Any

import click
import pytest

from autograder.cli import cli
from autograder.stages.catalogue import slips
from autograder.stages.slips.submission import submission_text
from autograder.verdicts import encode
from reference_solution import slam1d
from tests.reports.examples import small_class

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
PAGE = (DOCS / "interop.md").read_text(encoding="utf-8")
WORKFLOWS = sorted((DOCS / "examples").glob("*.yml"))
REFERENCE = Path(slam1d.__file__).read_text(encoding="utf-8")
SHOWN = re.findall(r"(?:^|`)(autograder (?:export \w+|grade)[^`\n#&]*)", PAGE, flags=re.MULTILINE)


def steps(path: Path) -> list[str]:
    """Return what the steps of a workflow run, in order."""
    text = path.read_text(encoding="utf-8")
    blocks = re.findall(r"^ +run: \|\n((?: {10}.*\n?)+)|^ +run: (.+)$", text, flags=re.MULTILINE)
    return [textwrap.dedent(block) or line for block, line in blocks]


def shell(command: str, folder: Path, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run a step as GitHub does, with the Python of this environment."""
    return subprocess.run(
        ["bash", "-e", "-o", "pipefail", "-c", command],
        cwd=folder,
        env={"PATH": f"{Path(sys.executable).parent}:/usr/bin:/bin", "HOME": str(folder), **environment},
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.parametrize("line", sorted(set(SHOWN)))
def test_a_command_that_is_shown_exists(line: str) -> None:
    """Its name and every option of it are known."""
    names = line.split()[1:]
    command: Any = cli
    while isinstance(command, click.Group):
        command = command.get_command(click.Context(command), names.pop(0))
    assert command is not None
    known = {option for parameter in command.params for option in parameter.opts}
    assert {word for word in names if re.match(r"--?[a-z]", word)} <= known


def test_every_link_leads_somewhere() -> None:
    """A link of the page is a file beside it."""
    links = re.findall(r"\]\(([^)]+)\)", PAGE)
    assert len(links) > 3
    assert [link for link in links if not (DOCS / link).exists()] == []


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.stem)
def test_a_workflow_is_plain_and_careful(path: Path) -> None:
    """Blanks only, least rights, a time limit, and no foreign text inside a script."""
    text = path.read_text(encoding="utf-8")
    assert "\t" not in text
    assert "permissions:\n  contents: read\n" in text
    assert "timeout-minutes:" in text
    assert steps(path)
    assert not [step for step in steps(path) if "${{" in step]


@pytest.mark.slow
def test_the_self_check_is_red_for_a_mistake_only(tmp_path: Path) -> None:
    """The step passes the reference and the stub, and fails a slip."""
    check = steps(DOCS / "examples" / "self-check.yml")[-1]
    for name in ("posegraph.py", "self_check.py", "slam1d.py"):
        shutil.copy(ROOT / "assignment" / name, tmp_path)
    assert shell(check, tmp_path).returncode == 0
    stub = (tmp_path / "slam1d.py").read_text(encoding="utf-8")
    (tmp_path / "slam1d.py").write_text(REFERENCE, encoding="utf-8")
    done = shell(check, tmp_path)
    assert (done.returncode, "FAIL" in done.stdout, "PASS" in done.stdout) == (0, False, True)
    wrong = submission_text(slips("jacobian")[0], "jacobian")
    (tmp_path / "slam1d.py").write_text(wrong, encoding="utf-8")
    assert shell(check, tmp_path).returncode == 1
    (tmp_path / "slam1d.py").write_text(stub + "\nraise RuntimeError\n", encoding="utf-8")
    assert shell(check, tmp_path).returncode == 1


@pytest.mark.slow
def test_a_folder_is_graded(tmp_path: Path) -> None:
    """The steps after the installation write the reports that the artifact holds."""
    (tmp_path / "submissions").mkdir()
    (tmp_path / "submissions" / "ann.py").write_text(REFERENCE, encoding="utf-8")
    course = "[grading]\nexamples = 5\n"
    (tmp_path / "course.toml").write_text(course, encoding="utf-8")
    grade = steps(DOCS / "examples" / "grade-folder.yml")[-1]
    done = shell(grade.replace("autograder doctor\n", ""), tmp_path, SEED="3")
    assert done.returncode == 0, done.stderr
    assert json.loads((tmp_path / "graded" / "run.json").read_text(encoding="utf-8"))["seed"] == 3
    assert (tmp_path / "graded" / "feedback" / "ann.html").exists()


@pytest.mark.slow
def test_prairielearn_gets_its_fields(tmp_path: Path) -> None:
    """A rejected submission, and one that was graded, leave what PrairieLearn's documentation asks for."""
    script = DOCS / "examples" / "prairielearn.py"
    (tmp_path / "student").mkdir()
    (tmp_path / "student" / "slam1d.py").write_bytes(b"\xff\xfe\0")
    done = subprocess.run([sys.executable, script, tmp_path], cwd=ROOT, capture_output=True, check=False)
    assert done.returncode == 0, done.stderr
    found = json.loads((tmp_path / "results" / "results.json").read_text(encoding="utf-8"))
    assert found["gradable"] is False
    assert len(found["format_errors"]) == 1
    converted = runpy.run_path(str(script))["converted"]
    for one in small_class():
        found = converted(json.loads(encode(one)))
        assert found["gradable"] is (one.status == "graded")
        if found["gradable"]:
            assert 0 <= found["score"] <= 1
            assert {"name", "points", "max_points", "message"} == set(found["tests"][0])
        else:
            assert found.get("message") or found.get("format_errors")
