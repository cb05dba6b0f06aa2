"""The table for mail merge: one line a student, harmless in a spreadsheet, and about nobody else."""

from __future__ import annotations

import csv
import io

import pytest

from autograder.errors import UsageError
from autograder.exports.mailmerge import COLUMNS, mailmerge
from autograder.problems.roster import Student
from tests.reports.examples import WRONG_J, result, small_class, stage

ROSTER = [Student("s1", "Ann Lee", "ann@uni.edu", line=2), Student("s2", "=1+1", "bob@uni.edu", line=3)]


def rows(text: str) -> list[dict[str, str]]:
    """Read the table."""
    return list(csv.DictReader(io.StringIO(text)))


def test_every_result_has_a_line() -> None:
    """Without a roster there is a line for each result; our own fault has no score."""
    found = rows(mailmerge(small_class())[0])
    assert [row["submission"] for row in found] == [one.submission for one in small_class()]
    assert list(found[0]) == list(COLUMNS)
    assert {row["submission"]: row["score"] for row in found}["kim"] == ""
    assert found[0]["feedback"].startswith("1D SLAM: 90 of 90 points")


def test_a_line_names_nobody_else() -> None:
    """No line of the table holds another student's name."""
    names = [one.submission for one in small_class()]
    for row in rows(mailmerge(small_class())[0]):
        words = "\n".join(row.values())
        assert [name for name in names if name in words and name != row["submission"]] == []


def test_the_roster_gives_names_and_addresses() -> None:
    """Students are found by id; who is missing on either side is said."""
    text, notes = mailmerge([result("x", student_id="S1"), result("stranger")], ROSTER)
    found = rows(text)
    assert (found[0]["name"], found[0]["email"], found[1]["email"]) == ("Ann Lee", "ann@uni.edu", "")
    assert any("stranger" in note for note in notes)
    assert any("s2" in note for note in notes)


def test_no_cell_is_a_formula() -> None:
    """Foreign text that a spreadsheet would run is put behind an apostrophe."""
    hostile = [result("a", student_id="s2"), result("=cmd|' /C calc'!A0"), result("@SUM(A1)", student_id="-2+3")]
    text, _ = mailmerge(hostile, ROSTER, course="=HYPERLINK(1)")
    cells = [cell for row in rows(text) for cell in row.values()]
    assert not [cell for cell in cells if cell[:1] in tuple("=+-@|%")]
    assert "'=1+1" in cells


@pytest.mark.parametrize(("policy", "shown", "hidden"), [
    ("full", ["J is off", "Hint: Which pose", "PoseGraph("], []),
    ("hint", ["Hint: Which pose", "wrong values"], ["J is off", "PoseGraph("]),
    ("score", ["jacobian: 0 of 15"], ["J is off", "Hint", "PoseGraph(", "wrong values"]),
])  # fmt: skip
def test_the_policy_decides_what_is_said(policy: str, shown: list[str], hidden: list[str]) -> None:
    """Points only, hints too, or everything: as on the page."""
    wrong = stage("jacobian", "failed", None, "J is off", WRONG_J, hint="Which pose does the factor predict?")
    said = rows(mailmerge([result("a", wrong)], policy=policy)[0])[0]["feedback"]
    assert all(words in said for words in shown)
    assert not [words for words in hidden if words in said]


def test_nothing_to_write_is_refused() -> None:
    """No results, or a roster of another course, end in a sentence."""
    with pytest.raises(UsageError, match="grade first"):
        mailmerge([])
    with pytest.raises(UsageError, match="fits none"):
        mailmerge([result("x")], ROSTER)
