"""When a command has returned, no process of it runs any more, however it ended."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.commands import left_over
from tests.engine import small_class

BUSY = small_class.REFERENCE + "\n\ndef jacobian(x, graph):\n    while True:\n        pass\n"
COMMANDS = {
    "grade": "grade uploads -o {out} --course course.toml --examples 1 --workers 2 --time-limit 20",
    "release": "release --roster class.csv --term T --secret-file secret.txt -o {out} --workers 2",
    "audit": "audit --examples 0",
    "demo": "demo -o {out} --workers 2",
}
CODES = {"SIGINT": {130}, "SIGTERM": {130}, "SIGKILL": {-9}}


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A class whose grading takes long, and a roster."""
    folder = small_class.make(tmp_path_factory.mktemp("processes"), {"busy": BUSY, "bob": BUSY + "\n"})
    names = "".join(f"s{number}\n" for number in range(24))
    (folder / "class.csv").write_text(f"student_id\n{names}", encoding="utf-8")
    (folder / "secret.txt").write_text("5" * 64, encoding="utf-8")
    return folder


def _end(place: Path, how: str, words: str) -> dict[str, Any]:
    program = [sys.executable, "-m", "autograder", *words.split()]
    driver = [sys.executable, left_over.__file__, how, *program]
    root = str(Path(__file__).parents[2])
    end = subprocess.run(
        driver, cwd=place, env={"PATH": "/usr/bin:/bin", "PYTHONPATH": root}, check=True, capture_output=True, text=True
    )
    found: dict[str, Any] = json.loads(end.stdout)
    return found


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "how"),
    [
        *(("grade", how) for how in CODES),
        *(("release", how) for how in CODES),
        ("audit", "SIGKILL"),
        ("audit", "SIGTERM"),
        ("demo", "SIGINT"),
    ],
)
def test_nothing_outlives_a_command_that_is_stopped(place: Path, tmp_path: Path, name: str, how: str) -> None:
    """Workers, fork servers and locked children end with it, also where it is killed outright."""
    end = _end(place, how, COMMANDS[name].format(out=tmp_path / "out"))
    assert end["most"] >= 2, "it was stopped before it had any process"
    assert end["code"] in CODES[how], end
    assert end["left"] == []
    assert "Traceback" not in end["said"]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "code"),
    [
        ("grade uploads -o {out} --course course.toml --examples 1 --workers 2 --time-limit 0.2", 0),
        ("grade uploads -o {out} --course course.toml --examples 1 --workers 2 --memory 70000", 2),
        ("release --roster class.csv --term T --secret-file secret.txt -o {out} --workers 2", 0),
    ],
)
def test_nothing_outlives_a_command_that_ends_by_itself(place: Path, tmp_path: Path, words: str, code: int) -> None:
    """At the moment it has returned, not a little later."""
    end = _end(place, "none", words.format(out=tmp_path / "out"))
    assert (end["code"], end["left"]) == (code, []), end
