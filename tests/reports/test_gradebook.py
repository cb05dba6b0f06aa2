"""grades.csv: the contract's columns, a row a submission, nothing a spreadsheet would run."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest

from autograder.errors import UsageError
from autograder.reports.gradebook import defused, gradebook_text, write_gradebook
from tests.reports.examples import POINTS, result, small_class, stage


def rows(text: str) -> list[dict[str, str]]:
    """Read grades.csv as a spreadsheet would."""
    return list(csv.DictReader(text.splitlines()))


def test_the_columns_are_those_of_the_contract() -> None:
    """Six fixed columns, then one a stage in the order of the course."""
    header = gradebook_text(small_class()).splitlines()[0].split(",")
    assert header == ["submission", "student_id", "variant", "status", "score", "max_score", *POINTS, "note"]


def test_a_row_says_what_the_result_says() -> None:
    """Scores are plain numbers; a stage that waits for a reader is empty."""
    [row] = rows(gradebook_text([result("alice", stage("written", "awaiting_mark"), student_id="a1")]))
    assert (row["submission"], row["student_id"], row["status"]) == ("alice", "a1", "graded")
    assert (row["score"], row["max_score"], row["residual"], row["written"]) == ("90", "90", "15", "")


def test_our_fault_is_no_zero() -> None:
    """A grader_error has an empty score; a rejected upload has 0."""
    by_name = {row["submission"]: row for row in rows(gradebook_text(small_class()))}
    assert by_name["kim"]["score"] == ""
    assert by_name["judy"]["score"] == "0"


def test_stages_of_the_course_have_a_column_before_anybody_reached_them() -> None:
    """A class of rejected uploads still has every column."""
    text = gradebook_text([result("judy", status="rejected")], list(POINTS))
    assert text.splitlines()[0].endswith(",".join([*POINTS, "note"]))


@pytest.mark.parametrize("start", ["=", "+", "-", "@", "\t=", "\r+", " =", "\uff1d"])
def test_a_name_is_never_a_formula(start: str) -> None:
    """Text that a spreadsheet would run begins with an apostrophe."""
    name = start + "HYPERLINK(1)"
    assert defused(name).startswith("'")
    [row] = rows(gradebook_text([result(name, student_id=name)]))
    assert row["submission"].startswith("'")
    assert row["student_id"].startswith("'")


def test_negative_scores_stay_numbers() -> None:
    """Only text is defused: a late penalty may leave a number below zero."""
    [row] = rows(gradebook_text([result("late", score=-2.5)]))
    assert row["score"] == "-2.5"


def test_names_with_commas_quotes_and_lines_keep_their_row() -> None:
    """The csv module quotes; nothing breaks into another column."""
    [row] = rows(gradebook_text([result('a,"b"\r\nc')]))
    assert row["submission"] == 'a,"b"  c'


def test_the_file_is_replaced_in_one_step(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A failure while writing leaves the old file as it was, and nothing beside it."""
    path = tmp_path / "grades.csv"
    write_gradebook([result("alice")], path)
    before = path.read_bytes()

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "replace", full)
    with pytest.raises(UsageError, match="No space"):
        write_gradebook([result("bob")], path)
    assert path.read_bytes() == before
    assert [p.name for p in tmp_path.iterdir()] == ["grades.csv"]
