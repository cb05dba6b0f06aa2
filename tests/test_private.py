"""What holds names or marks is for its owner, whatever the umask is; what a student sees holds nothing of the exam."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from autograder.commands._reporting import write_all
from autograder.course import Course
from autograder.engine.store import Store
from autograder.problems.replacing import replace_file, replace_folder
from autograder.reports.feedback import feedback_page
from tests.marking.written import answered


@pytest.fixture(params=[0o000, 0o022, 0o077], ids=oct)
def umask(request: pytest.FixtureRequest) -> Iterator[int]:
    """Set the umask of this process for a test."""
    before = os.umask(request.param)
    yield request.param
    os.umask(before)


def _open(folder: Path) -> list[str]:
    """List what somebody else may read, write or look into."""
    return [str(path) for path in (folder, *folder.rglob("*")) if stat.S_IMODE(path.stat().st_mode) & 0o077]


@pytest.mark.usefixtures("umask")
def test_results_and_reports_are_for_their_owner(tmp_path: Path) -> None:
    """Grades, pages, sheets and stored results."""
    out = tmp_path / "graded"
    Store(out).save(answered("ann"))
    write_all(out, [answered("ann")], {"versions": {}}, Course())
    assert (out / "grades.csv").exists()
    assert (out / "written.csv").exists()
    assert not _open(out)


@pytest.mark.usefixtures("umask")
def test_releases_are_for_their_owner(tmp_path: Path) -> None:
    """The folder and the zip of a student are handed out one by one."""
    replace_file(tmp_path / "release/zips/s1.zip", b"x")
    replace_folder(tmp_path / "release/students/s1", {"a.py": b"x", "figures/b.svg": b"y"})
    assert not _open(tmp_path / "release")


@pytest.mark.usefixtures("umask")
def test_what_the_instructor_opened_stays_open(tmp_path: Path) -> None:
    """A group that marks together is given the file once, and keeps it when it is written again."""
    out = tmp_path / "graded"
    Store(out).save(answered("ann"))
    write_all(out, [answered("ann")], {"versions": {}}, Course())
    (out / "grades.csv").chmod(0o640)
    write_all(out, [answered("ann", score=0.0)], {"versions": {}}, Course())
    assert stat.S_IMODE((out / "grades.csv").stat().st_mode) == 0o640


def test_a_page_says_nothing_of_the_exam(tmp_path: Path) -> None:
    """Whoever knows the seed and has this program has the whole exam."""
    shown: Any = answered("ann", seed=7_654_321, exam="e" * 64, flags=("In cell 2: the numbers of s1002.",))
    for policy in ("full", "hint", "score"):
        page = feedback_page(shown, policy, "1D SLAM")
        assert "7654321" not in page
        assert "e" * 16 not in page
        assert "s1002" not in page
