"""What a student reported is kept beside what is right, whatever it is."""

from __future__ import annotations

import msgspec
import numpy as np
import pytest

from autograder.desk.beside import beside
from autograder.engine.reported import reported
from autograder.problems.variants import published
from autograder.sandbox.host import Answers
from autograder.stages.answers import Sheet
from autograder.verdicts import Reported

SHEET = Sheet(published().identifier, published().graph, published().iterates)


@pytest.mark.parametrize(
    "iterates",
    [
        None,
        np.array(3.0),
        np.zeros(5),
        np.zeros((0, 5)),
        np.zeros((4, 0)),
        np.zeros((2, 2, 2)),
        np.full((3, 7), 77.0),
        np.full((4, 5), np.nan),
        np.full((4, 5), -np.inf),
        np.zeros((1000, 1000)),
        published().iterates,
    ],
)
def test_any_array_can_be_shown(iterates: np.ndarray | None) -> None:
    """It survives the file, and the desk lays it out: brackets round all that is not right."""
    found = reported(SHEET, Answers(iterates=iterates, conclusion="?!" * 100))
    again = msgspec.json.decode(msgspec.json.encode(found), type=Reported)
    laid = beside(again)
    assert laid is not None
    assert [[text for text, _ in row] for _, row in laid.given] == [] or iterates is not None
    wrong = [mark for _, row in laid.given for _, mark in row]
    right = iterates is not None and np.array_equal(iterates, published().iterates)
    assert not right or not any(wrong)
    assert right or all(wrong[5:])
    assert (len(again.conclusion), again.choice) == (40, "")


def test_the_letters_are_those_of_the_variant() -> None:
    """The published example's right letter is C; the choice is told in words."""
    found = reported(SHEET, Answers(conclusion="c"))
    assert (found.right_letter, found.letters["linear"]) == ("C", "C")
    assert found.choice.startswith("f is of a kind with which the first step ends")
    assert found.right[0] == [0.0, 1.1, 2.1, 3.2, 0.5]
