"""What the handout tells of a course: whatever it sets, the rows of the table add up to the total beneath them."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.problems.problem import worked_problem
from autograder.render.grading import Grading
from autograder.render.handout import render_assignment
from autograder.render.template import fill
from autograder.render.values import values
from autograder.stages.catalogue import bonus, points

WORTH = st.sampled_from([0.0, 0.5, 1.0, 7.25, 12.0, 40.0])


@given(st.fixed_dictionaries({}, optional=dict.fromkeys(points(), WORTH)))
def test_the_rows_add_up_to_the_total(chosen: dict[str, float]) -> None:
    """The total is the sum of the rows above it, and of the stages in use that are no bonus."""
    whole = chosen.get("written", 0.0)
    table = fill("parts/points.md.j2", **Grading(points=chosen, questions={"2": whole, "3": 0.0}).words())
    rows = re.findall(r"^\| (.*?) \| ([\d.]+)(?: each)? \|", table, re.MULTILINE)
    main = [value for name, value in chosen.items() if name not in bonus()]
    earned = [float(number) for name, number in rows if not name.startswith("bonus")]
    (total,) = re.findall(r"\*\*together\*\* \| \*\*(\S+)\*\*", table)
    assert sum(earned) == pytest.approx(float(total)) == pytest.approx(sum(main))
    named = {name for told, _ in rows for name in bonus() if told.startswith("bonus") and f"`{name}`" in told}
    assert named == {name for name in bonus() if chosen.get(name)}


def test_what_a_title_holds_is_shown_as_it_is() -> None:
    """Marks of Markdown, of formulas and of HTML in a title are letters of it."""
    files = render_assignment(worked_problem(), Grading(title="A *b* $5 `c` <d>\n%% code x"))
    assert files["README.md"].startswith("# A \\*b\\* \\$5 \\`c\\` \\<d\\> %% code x\n")
    assert ">A *b* $5 `c` &lt;d&gt; %% code x</h1>" in files["handout.html"]
    assert "<title>A *b* $5 `c` &lt;d&gt; %% code x</title>" in files["handout.html"]


def test_without_a_course_nothing_of_one_is_told() -> None:
    """The committed handout names no date."""
    assert values(worked_problem())["due"] == ""
    assert "until **" not in render_assignment(worked_problem())["README.md"]
