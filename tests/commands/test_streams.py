"""What is printed decides nothing: every command ends as it does in a terminal, whatever its streams are."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.engine import small_class

# How a shell hands the streams over; {} is the command.
STREAMS = {
    "stdout closed": "{} >&-",
    "stderr closed": "{} 2>&-",
    "all closed": "{} <&- >&- 2>&-",
    "stdout full": "{} >/dev/full",
    "both full": "{} >/dev/full 2>/dev/full",
    "stdout to read": "{} 1</dev/null",
    "first line only": "set -o pipefail; {} | head -1",
    "latin-1": "PYTHONIOENCODING=latin-1 {}",
    "ascii": "LC_ALL=C PYTHONUTF8=0 PYTHONCOERCECLOCALE=0 {}",
}
# A command of each kind, the exit code that it has, and what it leaves.
COMMANDS = {
    "--help": (0, ""),
    "nonsense": (2, ""),
    "report graded": (0, "graded/grades.csv"),
    "grade uploads -o out --examples 1 --course course.toml --workers 1": (0, "out/grades.csv"),
    "diff graded empty --json": (2, ""),
    "init new.toml": (0, "new.toml"),
}
NAME = "李雷_\udcff"  # a Chinese name, and a byte that is no text


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a class of one and its results."""
    folder = small_class.make(tmp_path_factory.mktemp("streams"), {NAME: small_class.CLASS["finn"]})
    end = _run(folder, f"{PROGRAM} grade uploads -o graded --examples 1 --course course.toml --workers 1")
    assert end.returncode == 0, end.stderr
    return folder


PROGRAM = f"'{sys.executable}' -m autograder"


def _run(folder: Path, line: str) -> subprocess.CompletedProcess[bytes]:
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[2])}
    return subprocess.run(
        ["bash", "-c", line], cwd=folder, env=environment, capture_output=True, check=False, timeout=60
    )


@pytest.mark.parametrize("stream", STREAMS)
@pytest.mark.parametrize("words", COMMANDS)
def test_a_stream_decides_no_outcome(place: Path, words: str, stream: str) -> None:
    """The exit code and the files are those of a run with good streams, and nobody sees a traceback."""
    code, left = COMMANDS[words]
    for path in (place / "new.toml", place / "out" / "grades.csv"):
        path.unlink(missing_ok=True)
    end = _run(place, STREAMS[stream].format(f"{PROGRAM} {words}"))
    assert end.returncode == code, end
    assert b"Traceback" not in end.stderr
    assert b"Exception ignored" not in end.stderr
    assert (place / left).exists()
