"""The terminal table: readable at 80 columns, without colour, and through a pipe."""

from __future__ import annotations

import io
import re

import msgspec
import pytest

from autograder.reports.summary import most_instructive, stage_summaries, troubles
from autograder.reports.terminal import class_table, console, print_class, went_wrong
from tests.reports.examples import GRAPH, POINTS, WRONG_J, result, small_class, stage


def printed(results: list, width: int) -> str:
    """Print a class as a pipe would get it."""
    file = io.StringIO()
    print_class(results, console(file, width))
    return file.getvalue()


@pytest.mark.parametrize("width", [80, 100, 140])
def test_no_line_is_wider_than_the_terminal(width: int) -> None:
    """Names are cut and headings broken before a line is."""
    assert max(map(len, printed(small_class(), width).splitlines())) <= width


def test_ten_stages_fit_into_eighty_columns() -> None:
    """Where headings do not fit, letters stand for them and a key below says which is which."""
    many = [stage(name) for name in ("answers", "written", "sparsity_pattern", "range_factor")]
    text = printed([result("alice", *many)], 80)
    assert max(map(len, text.splitlines())) <= 80
    assert "(j) range_factor" in text


def test_a_pipe_gets_no_colour(monkeypatch: pytest.MonkeyPatch) -> None:
    """Text that is not for a terminal holds no control characters."""
    monkeypatch.delenv("FORCE_COLOR", raising=False)
    assert not re.search(r"[\x00-\x09\x0b-\x1f]", printed(small_class(), 80))


def test_no_color_is_kept_and_the_marks_still_differ(monkeypatch: pytest.MonkeyPatch) -> None:
    """States are told apart by shape: the text is the same with and without colour."""
    monkeypatch.setenv("NO_COLOR", "1")
    monkeypatch.setenv("FORCE_COLOR", "1")
    plain = printed(small_class(), 80)
    assert "\x1b[3" not in plain
    for mark in ("7.5 ~", "0 x", "0 !", "0 T", "0 M", "0 -", "0 F"):
        assert mark in plain


def test_a_submission_that_was_not_graded_has_its_reason_in_the_line() -> None:
    """A rejected upload scores 0, our own fault has no score."""
    lines = printed(small_class(), 140).splitlines()
    [judy] = [line for line in lines if line.startswith("judy")]
    [kim] = [line for line in lines if line.startswith("kim")]
    assert "is no notebook" in judy
    assert judy.endswith(" 0")
    assert kim.endswith(" --")


def test_the_whole_reason_stands_below_the_table() -> None:
    """What is cut in the table is told in full, up to eight times."""
    lost = [
        result(f"s{k}", status="rejected", message="It is no notebook, " + "because of this " * 8) for k in range(10)
    ]
    text = printed(lost, 80)
    assert " ".join(text.split()).count("because of this " * 8) == 8
    assert "and 2 more" in text
    assert max(map(len, text.splitlines())) <= 80


def test_what_staff_should_look_at_stands_below_the_table() -> None:
    """Flags are listed with the submission; without any there is no list."""
    copied = result("bo", flags=("The start x^(0): the numbers of s1.", "s2 has 2 submissions."))
    text = printed([result("ann"), copied], 100)
    assert "For a human to look at\n  bo: The start x^(0): the numbers of s1. s2 has 2 submissions.\n" in text
    assert "For a human" not in printed([result("ann")], 100)


def test_means_are_over_graded_submissions_only() -> None:
    """Rejected uploads and our own faults do not lower the class mean."""
    summaries = {s.name: s for s in stage_summaries(small_class())}
    assert summaries["residual"].graded == 9
    assert summaries["residual"].mean == pytest.approx(7 * 15 / 9)
    assert "of 9" in printed(small_class(), 80)


def test_the_same_mistake_is_counted_once_for_all_who_made_it() -> None:
    """The most frequent reason stands first; one that spans stages is one line."""
    listed = troubles(small_class())
    assert (listed[0].count, listed[0].stage, listed[0].reason) == (2, "jacobian", "loop sign flipped")
    assert [(t.stage, t.submissions) for t in listed if t.reason == "not written"] == [("residual +5", ("erin",))]


def test_an_unnamed_mistake_is_shared_by_those_who_answered_alike() -> None:
    """Behaviour tells unnamed mistakes apart, not the words of the message; an error is told by its kind."""
    alike = [result(n, stage("jacobian", "failed", message=f"got {n}", group="g1")) for n in "ab"]
    other = result("c", stage("jacobian", "failed", message="got a", group="g2"))
    raised = [result(n, stage("residual", "error", message=f"raised IndexError: {n}", group=n)) for n in "12"]
    listed = troubles([*alike, other, *raised])
    assert [(t.stage, t.submissions) for t in listed] == [
        ("residual", ("1", "2")),
        ("jacobian", ("a", "b")),
        ("jacobian", ("c",)),
    ]


def test_what_follows_from_an_earlier_mistake_is_not_counted_again() -> None:
    """A step that is right by itself keeps its points, and is no mistake of its own."""
    step = stage("gauss_newton_step", "partial", 11.0)
    checks = tuple(msgspec.structs.replace(check, points=1.0) for check in step.checks)
    assert troubles([result("a", msgspec.structs.replace(step, checks=checks))]) == []


def test_a_class_without_mistakes_has_no_list_of_them() -> None:
    """Nothing went wrong: nothing is printed below the table."""
    assert went_wrong([result("alice")], 80) == []


def test_hostile_names_and_messages_cannot_move_the_cursor() -> None:
    """Control and bidi characters are printed as escapes; markup is text."""
    evil = "\x1b[2J\u202e[red]x\nkim"
    text = printed([result(evil, stage("residual", "error", message=f"raised {evil}"))], 140)
    assert "\x1b" not in text
    assert "\u202e" not in text
    assert "[red]" in text


def test_an_empty_class_is_no_table() -> None:
    """Where nothing is graded yet there is no table of nothing; the table itself does not fail."""
    assert printed([], 80) == ""
    assert class_table([], 80)[0].plain.startswith("submission")


def test_the_most_instructive_counterexample_is_a_named_slip_on_a_small_graph() -> None:
    """A recognised slip beats an unknown mistake, a small graph a large one."""
    large = {**WRONG_J, "graph": {**GRAPH, "n_poses": 100}}
    unknown = result("a", stage("residual", "failed", counterexample=WRONG_J))
    big = result("b", stage("jacobian", "failed", counterexample=large, slip="known"))
    small = result("c", stage("jacobian", "failed", counterexample=WRONG_J, slip="known"))
    picked = most_instructive([unknown, big, small])
    assert picked is not None
    assert picked[0].submission == "c"
    assert most_instructive([result("alice")]) is None
    assert list(POINTS)[1] == picked[1].name
