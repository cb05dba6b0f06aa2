"""The examples of docs/interop.md do what the page says: their commands run, their files have the right shape."""

from __future__ import annotations

import json
import re
import runpy
import shlex
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import click
import pytest
import yaml

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


def steps(path: Path) -> list[dict[str, Any]]:
    """Return the steps of a workflow's only job, in order."""
    (job,) = yaml.safe_load(path.read_text(encoding="utf-8"))["jobs"].values()
    found: list[dict[str, Any]] = job["steps"]
    return found


def shell(command: str, folder: Path, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run a step as GitHub does where it names no shell, with the Python of this environment."""
    path = f"{folder}/bin:{Path(sys.executable).parent}:/usr/bin:/bin"
    return subprocess.run(
        ["bash", "-e", "-c", command],
        cwd=folder,
        env={"PATH": path, "HOME": str(folder), **environment},
        capture_output=True,
        text=True,
        check=False,
    )


def run_job(path: Path, folder: Path, **environment: str) -> tuple[bool, list[str]]:
    """Run the steps but for installations; return whether all passed, and the folders that are uploaded."""
    green, uploaded = True, []
    for step in steps(path):
        if not green and "!cancelled()" not in str(step.get("if")):
            continue
        if "upload-artifact" in step.get("uses", ""):
            uploaded.append(step["with"]["path"])
        elif "run" in step and "install" not in step["run"]:
            green = green and shell(step["run"], folder, **environment).returncode == 0
    return green, uploaded


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
    assert not [step for step in steps(path) if "${{" in step.get("run", "")]


STUB = (ROOT / "assignment" / "slam1d.py").read_text(encoding="utf-8")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("text", "green"),
    [
        (STUB, True),
        (REFERENCE, True),
        (submission_text(slips("jacobian")[0], "jacobian"), False),
        (STUB + "\nraise RuntimeError\n", False),
        ("def residual(x, graph:\n", False),
        (None, False),
    ],
    ids=["stub", "reference", "slip", "raises", "does not parse", "missing"],
)
def test_the_self_check_is_red_for_a_mistake_only(tmp_path: Path, text: str | None, green: bool) -> None:
    """The job passes the reference and the stub; it fails a slip, and a file that does not run."""
    for name in ("posegraph.py", "self_check.py"):
        shutil.copy(ROOT / "assignment" / name, tmp_path)
    if text is not None:
        (tmp_path / "slam1d.py").write_text(text, encoding="utf-8")
    assert run_job(DOCS / "examples" / "self-check.yml", tmp_path) == (green, [])


# An autograder that finds this machine ready at once, and one of the class not to be graded.
THREE = """#!/bin/sh
test "$1" = doctor && exit 0
{} -m autograder "$@"
exit {}
"""


@pytest.mark.slow
@pytest.mark.parametrize("code", [0, 3])
def test_a_folder_is_graded(tmp_path: Path, code: int) -> None:
    """The reports are uploaded, also where the run is red because one could not be graded."""
    (tmp_path / "submissions").mkdir()
    (tmp_path / "submissions" / "ann.py").write_text(REFERENCE, encoding="utf-8")
    (tmp_path / "submissions" / "bob.py").write_text("def residual(x, graph:\n", encoding="utf-8")
    course = "[grading]\nexamples = 5\n"
    (tmp_path / "course.toml").write_text(course, encoding="utf-8")
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "autograder").write_text(THREE.format(shlex.quote(sys.executable), code), encoding="utf-8")
    (tmp_path / "bin" / "autograder").chmod(0o755)
    path = DOCS / "examples" / "grade-folder.yml"
    assert run_job(path, tmp_path, SEED="3", PYTHONPATH=str(ROOT)) == (code == 0, ["graded"])
    assert json.loads((tmp_path / "graded" / "run.json").read_text(encoding="utf-8"))["seed"] == 3
    assert (tmp_path / "graded" / "feedback" / "ann.html").exists()
    assert (tmp_path / "graded" / "feedback" / "bob.html").exists()


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
