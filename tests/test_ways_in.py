"""A folder of uploads is the current folder: no way into the grader runs a file of it in the grader's own process."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
NAMES = ("csv", "socket", "pickle", "json", "msgspec", "numpy", "random", "tempfile", "logging", "click", "selectors")


@pytest.fixture
def uploads(tmp_path: Path) -> Path:
    """Write a class whose files have the names of modules that the grader imports; each leaves a mark where it runs."""
    folder = tmp_path / "class of uploads"
    folder.mkdir()
    for name in NAMES:
        mark = f"open({str(tmp_path / 'ran')!r}, 'a').write({name!r})"
        (folder / f"{name}.py").write_text(f"try:\n    {mark}\nexcept OSError:\n    pass\nraise SystemExit(77)\n")
    return folder


def _started(folder: Path, *command: str) -> None:
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONSAFEPATH"}
    done = subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, timeout=120, check=False
    )
    ran = folder.parent / "ran"
    assert not ran.exists(), ran.read_text()
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    "way",
    [
        ("-m", "autograder"),
        ("-I", "-m", "autograder"),
        ("-P", "-c", "from autograder.cli import main; main()"),
    ],
    ids=["-m", "-I -m", "console script"],
)
def test_grading_the_current_folder_runs_nothing_of_it_in_the_grader(uploads: Path, way: tuple[str, ...]) -> None:
    """Two workers are started, and the fork server of each: none of them looks into the folder either."""
    _started(uploads, sys.executable, *way, "grade", ".", "-o", "../out", "--workers", "2", "--examples", "5")
    rows = (uploads.parent / "out/grades.csv").read_text().splitlines()
    assert len(rows) == 1 + len(NAMES)


def test_the_processes_of_a_release_run_nothing_of_the_current_folder(uploads: Path) -> None:
    """They are fresh interpreters, and a fresh interpreter looks into the current folder first unless it is told."""
    (uploads / "class.csv").write_text("student_id\n" + "".join(f"s{number}\n" for number in range(20)))
    (uploads / "secret.txt").write_text("0123456789abcdef0123456789abcdef\n")
    arguments = ("release", "--roster", "class.csv", "--term", "2026S", "--secret-file", "secret.txt", "-o", "../rel")
    _started(uploads, sys.executable, "-m", "autograder", *arguments, "--workers", "2")


def test_gradescopes_run_starts_python_isolated() -> None:
    """There the current folder is what the student uploaded, or above it."""
    script = (ROOT / "autograder/exports/gradescope/run_autograder").read_text()
    assert 'bin/python" -I -m autograder.commands._on_gradescope' in script


def test_the_package_imports_nothing_before_the_path_is_clean() -> None:
    """`autograder/__init__.py` imports only what every Python has loaded by then."""
    lines = (ROOT / "autograder/__init__.py").read_text().splitlines()
    imports = [line for line in lines if line.lstrip().startswith(("import ", "from "))]
    assert imports == ["import os", "import sys"]
