"""First lines of specimens are read by the form that their README gives, and compared stage by stage."""

from __future__ import annotations

import pytest

from autograder.audit.expectation import CAUGHT, KEPT, Cell, Expected, compare, expected
from autograder.verdicts import CheckVerdict, StageVerdict

BROKEN = (
    "",
    "import numpy as np",
    "# expect: others=passed",
    "# expect: jacobian=failed; no clause for the others.",
    "# expect: others=passed others=failed; two of them.",
    "# expect: others=passed  remark=lists; two spaces.",
    "# expect: others=passed; no full stop",
    "# expect: others=passed; one; two.",
)


@pytest.mark.parametrize("line", BROKEN)
def test_a_line_that_breaks_the_form_is_refused(line: str) -> None:
    """The message shows the line and the form."""
    with pytest.raises(ValueError, match="expected"):
        expected(line)


def verdict(name: str, status: str, **more: object) -> StageVerdict:
    """Make a verdict of a stage that is worth 10 points."""
    return StageVerdict(**{"name": name, "status": status, "score": 0.0, "max_score": 10.0, **more})  # type: ignore[arg-type]  # as given


FOLLOWED = (CheckVerdict(name="priors", passed=False, points=5.0, max_points=10.0, cases=1),)


def cells(line: str, *verdicts: StageVerdict, follow_through: bool = True) -> dict[str, tuple[str, str]]:
    """Compare and return stage -> (expected, got)."""
    found = compare(expected(line), verdicts, follow_through=follow_through)
    return {cell.stage: (cell.expected, cell.got) for cell in found}


def test_every_part_of_a_verdict_is_compared() -> None:
    """Status, slip and follow-through each make a cell wrong."""
    line = "# expect: residual=failed:a_slip gauss_newton_step=partial+follow_through others=passed; all parts."
    step = verdict("gauss_newton_step", "partial", checks=FOLLOWED)
    assert cells(line, verdict("residual", "failed", slip="a_slip"), step, verdict("jacobian", "error")) == {
        "residual": ("failed:a_slip", "failed:a_slip"),
        "gauss_newton_step": ("partial+follow_through", "partial+follow_through"),
        "jacobian": ("passed", "error"),
        "remarks": ("none", "none"),
    }
    assert cells(line, verdict("residual", "failed"))["residual"] == ("failed:a_slip", "failed")


def test_remarks_are_compared_by_kind() -> None:
    """A remark that is not stated, one that is missing, and one of no known kind are seen."""
    line = "# expect: others=passed remark=rows; rows."
    row = "f returns a column or a row; a vector is expected, and it was read as one."
    assert cells(line, verdict("residual", "passed", remarks=(row,)))["remarks"] == ("rows", "rows")
    assert cells(line, verdict("residual", "passed"))["remarks"] == ("rows", "none")
    assert cells(line, verdict("residual", "passed", remarks=("new",)))["remarks"] == ("rows", "new")


def test_others_speak_of_functions_that_must_be_written() -> None:
    """Bonus stages and reported answers are asked for only by name."""
    bonus, answers = verdict("sparsity_pattern", "missing", bonus=True), verdict("answers", "missing")
    assert set(cells("# expect: others=passed; nothing else.", bonus, answers)) == {"remarks"}
    assert cells("# expect: answers=failed others=passed; named.", answers)["answers"] == ("failed", "missing")


def test_a_course_is_asked_for_what_it_can_show() -> None:
    """Without points nothing is partly right; without a share nothing follows through."""
    line = "# expect: gauss_newton_step=partial+follow_through others=partial; a course that pays nothing."
    worthless = verdict("residual", "failed", max_score=0.0)
    assert cells(line, worthless)["residual"] == ("failed", "failed")
    unpaid = verdict("gauss_newton_step", "failed")
    assert cells(line, unpaid, follow_through=False)["gauss_newton_step"] == ("failed", "failed")
    assert cells(line, unpaid)["gauss_newton_step"] == ("partial+follow_through", "failed")


def test_a_slip_may_show_as_failed_partial_or_error() -> None:
    """But it has to be caught, and named."""
    wanted = Expected(stages={"jacobian": (CAUGHT, "a_slip", False)})
    for status in ("failed", "partial", "error"):
        assert compare(wanted, [verdict("jacobian", status, slip="a_slip")])[0].right
        assert not compare(wanted, [verdict("jacobian", status)])[0].right
    assert compare(wanted, [verdict("jacobian", "passed")])[0].fault == "miss"


def test_what_runs_into_a_limit_may_end_in_any_way() -> None:
    """A recursion without a bound takes all its time with one Python, and crashes the next."""
    wanted = expected("# expect: jacobian=ended others=passed; calls itself.")
    assert all(compare(wanted, [verdict("jacobian", way)])[0].right for way in ("timeout", "memory", "error"))
    assert compare(wanted, [verdict("jacobian", "passed")])[0].fault == "miss"
    assert not compare(wanted, [verdict("jacobian", "failed")])[0].right


def test_a_step_is_kept_where_it_is_passed_or_right_by_itself() -> None:
    """A mistake in an earlier function must cost the step nothing; a course that pays no share cannot show that."""
    wanted = Expected(stages={"second_step": (KEPT, "", False)})
    assert compare(wanted, [verdict("second_step", "passed")])[0].right
    by_itself = StageVerdict(name="second_step", status="partial", score=8.0, max_score=10.0, checks=checks(4.0, 4.0))
    in_part = StageVerdict(name="second_step", status="partial", score=4.0, max_score=10.0, checks=checks(4.0, 0.0))
    assert compare(wanted, [by_itself])[0].right
    assert compare(wanted, [in_part])[0].fault == "false alarm"
    assert compare(wanted, [in_part], follow_through=False)[0].right


def checks(*earned: float) -> tuple[CheckVerdict, ...]:
    """Make failed checks that earned so many of 5 points."""
    return tuple(
        CheckVerdict(name=str(place), passed=False, points=each, max_points=5.0, cases=1)
        for place, each in enumerate(earned)
    )


def test_a_wrong_cell_says_who_is_wronged() -> None:
    """A right answer refused, a wrong one accepted, and another verdict than expected are three faults."""
    assert Cell("residual", "passed", "failed").fault == "false alarm"
    assert Cell("residual", "failed:a_slip", "passed").fault == "miss"
    assert Cell("residual", "failed:a_slip", "failed").fault == "misjudged"
    assert Cell("residual", "passed", "passed").fault == ""
