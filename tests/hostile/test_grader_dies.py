"""Whoever ends the grader ends all that it started: no worker, no fork server and no submission lives on."""

from __future__ import annotations

from pathlib import Path

from tests.hostile import corpus
from tests.hostile.conftest import grade


def test_a_killed_grader_leaves_no_process(place: Path) -> None:
    """The grader is killed while a submission sleeps; everything below it is gone within a second."""
    folder = place / "sleeping"
    folder.mkdir()
    name = "case_87_outlive_the_grader.py"
    for copy in (name, f"again_{name}"):  # one submission alone would be graded without a worker
        (folder / copy).write_bytes((corpus.folder() / name).read_bytes())
    guard = grade(folder, place / "killed", ["--examples", "3", "--time-limit", "10", "--workers", "1"], "kill").guard
    assert guard["code"] == -9, "the grader ended before it could be killed"
    assert guard["processes_left"] == 0
    assert guard["seconds_after"] < 1.0
