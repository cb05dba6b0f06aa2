"""Overrides, times, settings and comparisons."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path

import msgspec
import pytest

from autograder.course import Course
from autograder.errors import UsageError
from autograder.marking.comparing import moved
from autograder.marking.folder import decided, store_course, stored_course
from autograder.marking.lateness import moment
from autograder.marking.overrides import check_overrides, read_overrides
from tests.marking.written import answered
from tests.reports.examples import stage

HEAD = "student,stage,points,reason,who,when\n"
DUE = datetime(2026, 11, 20, 23, 59, tzinfo=UTC)


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("ann,residual,12,,Prof,today", "reason is empty"),
        ("ann,residual,many,r,Prof,today", "points are 'many'"),
        ("ann,residual,-1,r,Prof,today", "points are '-1'"),
        ("ana,residual,1,r,Prof,today", "no submission or student id 'ana'; did you mean ann"),
        ("ann,resid,1,r,Prof,today", "stage is 'resid', expected residual, "),
        ("ann,residual,16,r,Prof,today", "16 points, but residual has 15"),
        ("ann,total,880,r,Prof,today", "880 points, but there are "),
        (
            "ann,residual,1,r,Prof,today\nann,residual,2,r,Prof,today",
            "Line 3: ann has an override of residual in line 2",
        ),
    ],
)
def test_an_override_that_cannot_hold_is_named_with_its_line(tmp_path: Path, line: str, words: str) -> None:
    """Nothing is guessed, nothing is dropped in silence."""
    (tmp_path / "overrides.csv").write_text(f"{HEAD}{line}\n")
    with pytest.raises(UsageError) as error:
        decided(tmp_path, [answered("ann")])
    assert words in str(error.value)
    assert "overrides.csv" in str(error.value)


def test_a_run_of_part_of_a_class_leaves_the_others_overrides_alone(tmp_path: Path) -> None:
    """Grading does not stop for a line about somebody who has not handed in yet; it is said."""
    (tmp_path / "overrides.csv").write_text(f"{HEAD}zoe,residual,1,r,Prof,today\nann,residual,10,r,Prof,today\n")
    found = decided(tmp_path, [answered("ann")], strict=False)
    assert found.results[0].score == 90.0
    assert "line 2, changes nothing" in found.notes[0]
    assert len(check_overrides(read_overrides(tmp_path), found.stored)) == 1


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("2026-11-20 23:59:00 Z", "2026-11-20T23:59:00+00:00"),
        ("2026-11-20 23:59:00.123456 UTC", "2026-11-20T23:59:00+00:00"),
        ("2026-11-20T23:59:00+01:00", "2026-11-20T23:59:00+01:00"),
        ("2026-11-20 23:59", "2026-11-20T23:59:00+00:00"),
        ("2026-11-20 23:59:00 Nowhere/City", None),
        ("2026-13-40 23:59:00 Z", None),
        ("2026-11-20 23:59:00 +9999", None),
        ("", None),
    ],
)
def test_times_are_read_as_platforms_write_them(text: str, expected: str | None) -> None:
    """A time without a zone is one of the course's; what is no time is none."""
    found = moment(text, UTC)
    assert (found.isoformat() if found else None) == expected


def test_the_settings_in_force_are_kept(tmp_path: Path) -> None:
    """With dates, extensions and points of questions."""
    course = Course(due=DUE, extensions={"ann": DUE}, question_points={"2": 1.0, "3": 4.0}, title="Ünï")
    store_course(tmp_path, course)
    assert stored_course(tmp_path) == course
    assert stored_course(tmp_path / "none") is None


def test_a_comparison_says_who_by_how_much_by_which_check_and_why() -> None:
    """And who is in one run only; who is the same is not listed."""
    worse = answered("ann")
    lost = stage("jacobian", "partial", 7.5, "column 2 is off")
    worse = msgspec.structs.replace(
        worse, stages=tuple(lost if s.name == "jacobian" else s for s in worse.stages), score=87.5
    )
    found = {one.submission: one for one in moved([answered("ann"), answered("bob"), answered("old")],
                                                 [worse, answered("bob"), answered("new")])}  # fmt: skip
    assert sorted(found) == ["ann", "new", "old"]
    assert found["ann"].by == -7.5
    assert found["ann"].reasons[0].startswith("jacobian: 15 -> 7.5: ")
    assert "several loops passed -> failed (column 2 is off)" in found["ann"].reasons[0]
    assert found["new"].reasons == ("only in the second",)
    assert found["old"].after is None
