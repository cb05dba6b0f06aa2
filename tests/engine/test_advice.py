"""Advice is read off the text of a function and off what it raised, and the text is only ever shown to its author."""

from __future__ import annotations

import pytest

from autograder.engine.advice import advised
from autograder.sandbox.frames import Source
from autograder.sandbox.outputs import with_line
from autograder.verdicts import StageVerdict

STEP = "def gauss_newton_step(J, r):\n    '''Uses my_graph.'''\n    return J  # my_graph\n\n\nmy_graph = 3\n"
OWN = "def gauss_newton_step(x, graph):\n    return my_graph.edges\n"


def verdict(message: str) -> StageVerdict:
    """Make a verdict of a step that went wrong without a name."""
    return StageVerdict(
        name="gauss_newton_step", status="error", score=0.0, max_score=20.0, bonus=False, message=message, group="g"
    )


def test_parameters_are_told_where_it_raised() -> None:
    """The call and the parameters stand side by side; comments and docstrings use nothing."""
    said = advised([verdict("gauss_newton_step(x, graph) raised ValueError: no.")], [STEP])[0].message
    assert "It is called as gauss_newton_step(x, graph), and your gauss_newton_step takes (J, r)." in said
    assert "own graph" not in said
    assert advised([verdict("it is wrong.")], [STEP])[0].message == "it is wrong."


def test_an_own_graph_is_told() -> None:
    """Code that looks at my_graph is shown."""
    assert "`return my_graph.edges`" in advised([verdict("it is wrong.")], [OWN])[0].message


@pytest.mark.parametrize("place", ["[0:9]", "[9:1]", "[0:0]", "[999999:9999999]"])
def test_a_line_that_is_not_there_is_not_shown(place: str) -> None:
    """A child names a line by two numbers; where there is no such line, nothing is shown, and the numbers neither."""
    assert with_line(f"ValueError: no {place}", Source("module", [OWN], "a.py")) == "ValueError: no"
