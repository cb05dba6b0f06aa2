"""One run of the real command over a class of honest and hostile submissions, shared by the tests of this room."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from autograder.verdicts import Result, decode
from tests.hostile import corpus, neighbours, traces, uploads

ROOT = Path(__file__).resolve().parents[2]
GUARD = Path(__file__).with_name("guard.py")
SECRET = "SLAM1D_CANARY_SECRET"
COURSE = "[limits]\nmemory = 128\noutput = 2\n"
OPTIONS = ("--examples", "3", "--time-limit", "0.25")


@dataclass(frozen=True)
class Graded:
    """What a run left in its folder, and what the guard saw of it."""

    out: Path
    uploads: Path
    guard: dict[str, Any]
    printed: str

    def result(self, name: str) -> Result:
        """Read the result of one submission."""
        return decode((self.out / "results" / f"{name}.json").read_bytes())

    def results(self) -> dict[str, Result]:
        """Read all results, by submission."""
        return {path.stem: decode(path.read_bytes()) for path in (self.out / "results").glob("*.json")}


def grade(folder: Path, out: Path, options: Sequence[str] = OPTIONS, mode: str = "watch") -> Graded:
    """Grade a folder with the real command, under the eyes of the guard."""
    course = out.parent / "course.toml"
    course.write_text(COURSE)
    report = out.with_suffix(".guard.json")
    command = [sys.executable, "-m", "autograder", "grade", folder, "-o", out, "--course", course, *options]
    ended = subprocess.run(
        [sys.executable, GUARD, report, mode, *map(str, command)],
        cwd=ROOT,
        env={**os.environ, SECRET: "x"},
        capture_output=True,
        text=True,
        errors="surrogateescape",
        timeout=300,
        check=True,
    )
    return Graded(out, folder, json.loads(report.read_text()), ended.stdout + ended.stderr)


@pytest.fixture(scope="session")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where the runs of this room lie."""
    assert not traces.found(), "something of an earlier run is left; remove it by hand"
    return tmp_path_factory.mktemp("hostile")


@pytest.fixture(scope="session")
def honest_names(place: Path) -> list[str]:
    """The honest submissions, alone in their folder."""
    return neighbours.write(place / "honest")


@pytest.fixture(scope="session")
def alone(place: Path, honest_names: list[str]) -> Graded:
    """The honest submissions, graded by themselves."""
    return grade(place / "honest", place / "alone")


@pytest.fixture(scope="session")
def together(place: Path, honest_names: list[str]) -> Graded:
    """The honest submissions in one class with every hostile one."""
    folder = place / "class"
    neighbours.write(folder)
    for case in corpus.cases():
        (folder / case.path.name).write_bytes(case.path.read_bytes())
    for upload in uploads.uploads():
        (folder / upload.name).write_bytes(upload.data)
    return grade(folder, place / "together")
