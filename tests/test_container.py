"""The container that grades where a machine has no lock: built from the lock file, and what doctor prints starts it.

No Docker engine is at hand in these tests: they follow the file's steps as far as files go.
"""

from __future__ import annotations

import json
import re
import shlex
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import click

from autograder.cli import cli
from autograder.commands._remedy import CONTAINER

ROOT = Path(__file__).resolve().parent.parent
STEPS = [line.split(maxsplit=1) for line in (ROOT / "Dockerfile").read_text("utf-8").splitlines() if line[:1].isalpha()]
COPIED = [name for step, rest in STEPS if step == "COPY" for name in rest.split()[:-1]]


def test_it_is_built_from_the_lock() -> None:
    """Packages come from requirements.lock with their hashes, before the source is copied, and from nowhere else."""
    installs = [rest for step, rest in STEPS if step == "RUN"]
    assert "--require-hashes -r requirements.lock" in installs[0]
    assert "--no-deps --no-build-isolation ." in installs[1]
    assert len(installs) == 2
    assert COPIED[0] == "requirements.lock"


def test_what_is_copied_is_enough_for_a_wheel(tmp_path: Path) -> None:
    """From the copied files alone a wheel is built, and it holds the specimens and the templates."""
    for name in COPIED:
        if (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, tmp_path / name, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy(ROOT / name, tmp_path / name)
    build = [sys.executable, "-m", "hatchling", "build", "--target", "wheel", "--directory", "out"]
    run = subprocess.run(build, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    (wheel,) = (tmp_path / "out").glob("*.whl")
    with zipfile.ZipFile(wheel) as archive:
        names = set(archive.namelist())
    assert "autograder/specimens/hostile/case_01_open_the_solution.py" in names
    assert "autograder/reports/templates/feedback.html.j2" in names


def test_the_printed_command_runs_in_it() -> None:
    """The image has the printed name, starts the command line, and gets no network while it grades."""
    build, run = (shlex.split(line.replace("{here}", "here")) for line in CONTAINER)
    image = build[build.index("-t") + 1]
    assert ["ENTRYPOINT", '["autograder"]'] in STEPS
    assert run[run.index("--network") + 1] == "none"
    assert cli.get_command(click.Context(cli), run[run.index(image) + 1]) is not None


def test_the_python_is_one_that_the_project_supports() -> None:
    """The version of the image is in the classifiers."""
    version = re.fullmatch(r"python:(3\.\d+)-slim", dict(STEPS)["FROM"])
    assert version is not None
    assert f"Python :: {version[1]}" in (ROOT / "pyproject.toml").read_text("utf-8")


def test_the_development_container_is_the_same() -> None:
    """It is built from the same file, which lies where it says."""
    folder = ROOT / ".devcontainer"
    build = json.loads((folder / "devcontainer.json").read_text("utf-8"))["build"]
    assert (folder / build["dockerfile"]).resolve() == ROOT / "Dockerfile"
    assert (folder / build["context"]).resolve() == ROOT
