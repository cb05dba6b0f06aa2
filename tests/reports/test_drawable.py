"""A case that cannot be drawn costs its picture, never a page, a mark or a class."""

import pytest

from autograder.attempts import STRICT
from autograder.reports import feedback
from autograder.reports.drawable import drawable
from autograder.reports.folder import write_reports
from tests.reports.examples import WRONG_J, result, stage


def broken(*_):
    """Fail as drawing a case may."""
    raise ValueError("no such shape")


def wrong():
    """A result with a case."""
    words = "row 2 (edge 0 -> 2) of J: got [1 0 1], expected [1 0 -1]."
    return result("ada", stage("jacobian", "failed", message=words, counterexample=WRONG_J))


def test_a_page_that_can_be_drawn_is_as_it_was():
    """Nothing is left out where nothing fails."""
    assert drawable(wrong()) == (wrong(), feedback.feedback_page(wrong()))


def test_without_its_case_a_page_still_says_what_is_wrong(monkeypatch, tmp_path):
    """The page has the sentence, the class page a flag, and both are written."""
    monkeypatch.delenv(STRICT)
    monkeypatch.setattr(feedback, "drawn", broken)
    write_reports([wrong()], tmp_path, {})
    assert "row 2" in (tmp_path / "feedback" / "ada.html").read_text("utf-8")
    assert "drawing its page failed (ValueError: no such shape)" in (tmp_path / "report.html").read_text("utf-8")
    assert "no such shape" not in (tmp_path / "feedback" / "ada.html").read_text("utf-8")


def test_our_tests_see_it(monkeypatch):
    """Under our tests a page that cannot be drawn is an error."""
    monkeypatch.setattr(feedback, "drawn", broken)
    with pytest.raises(ValueError, match="no such shape"):
        drawable(wrong())
