"""A counterexample in text: a picture, a call to paste, and aligned matrices with the wrong entries marked."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assignment.posegraph import PoseGraph
from autograder.reports.comparison import parts
from autograder.reports.counterexample import counterexample_text
from autograder.reports.picture import picture
from autograder.reports.reproduce import call_text
from autograder.reports.wording import number
from tests.reports.examples import GRAPH, WRONG_J, WRONG_NORMAL


def test_wrong_entries_stand_in_brackets_beside_the_expected_ones() -> None:
    """Every row is named by its factor, -0. is 0, and only the wrong entry is marked."""
    text = counterexample_text(WRONG_J)
    assert text.endswith(
        """
         got            expected   (wrong entries in brackets)
J        x0  x1  x2     x0 x1 x2
0 -> 1    1  -1   0      1 -1  0
1 -> 2    0   1  -1      0  1 -1
0 -> 2    1   0  [1]     1  0 -1
prior 0   1   0   0      1  0  0"""
    )
    assert "-0 " not in text
    assert "-0." not in text


def test_the_picture_shows_odometry_above_and_the_loop_below() -> None:
    """Poses stand on a line; an edge between others than neighbours is an arc below."""
    assert picture(GRAPH) == (
        "       1            1.5\nx0 ---------> x1 ---------> x2\no------------ 2 ------------>\n^ prior, mean 0"
    )


def test_backward_and_double_edges_are_drawn() -> None:
    """An arrow points where the edge points; a second edge between neighbours is an arc."""
    drawn = picture(
        {
            "n_poses": 3,
            "edges": [[1, 0], [0, 1], [2, 0]],
            "measurements": [-1, 1, 0.5],
            "priors": [2],
            "prior_means": [3],
        }
    )
    assert drawn.splitlines() == [
        "       -1",
        "x0 <--------- x1            x2",
        "o----- 1 ----->",
        "<----------- 0.5 -----------o",
        "                            ^ prior, mean 3",
    ]


@pytest.mark.parametrize("n_poses", [2, 5, 8, 9, 100])
def test_a_picture_fits_into_eighty_columns(n_poses: int) -> None:
    """Up to eight poses are drawn; more are listed."""
    graph = {
        "n_poses": n_poses,
        "edges": [[k, k + 1] for k in range(n_poses - 1)] + [[0, n_poses - 1]],
        "measurements": [0.5] * n_poses,
        "priors": [0],
        "prior_means": [0.0],
    }
    drawn = picture(graph)
    assert max(map(len, drawn.splitlines())) <= 80
    assert ("x1" in drawn) == (n_poses <= 8)


def test_only_the_wrong_one_of_two_arrays_is_spread_out() -> None:
    """H was right, so one line says so; b is shown entry by entry."""
    text = counterexample_text(WRONG_NORMAL)
    assert "H: as expected" in text
    assert "x0  [0.5]      987.5" in text


@pytest.mark.parametrize(
    ("got", "words"),
    [
        (None, "f: got nothing, expected an array of shape (4,)"),
        ("raised ValueError: \x1b[2J no", r"f: got raised ValueError: \x1b[2J no, expected an array of shape (4,)"),
        ([1.0, 2.0], "f: got shape (2,), expected shape (4,)"),
        ([[1.0], [2.0], [3.0], [4.0]], "f: got shape (4, 1), expected shape (4,)"),
        ([None, 0.0, 0.0, 0.0], "0 -> 1   [nan]"),
    ],
)
def test_what_came_instead_is_said(got: Any, words: str) -> None:
    """Something else than an array of the right shape is named, control characters made visible."""
    text = counterexample_text(
        {"function": "residual", "graph": GRAPH, "x": [0, 0, 0], "expected": [0.0] * 4, "got": got}
    )
    assert words in text
    assert "\x1b" not in text


def test_a_large_array_is_told_by_its_first_difference() -> None:
    """Beyond 6 x 6 a reader gets the shape, how many entries are wrong, and the first of them."""
    right = np.eye(7)
    wrong = right.copy()
    wrong[3, 2] = 5.0
    text = counterexample_text({"function": "jacobian", "expected": right.tolist(), "got": wrong.tolist()})
    assert text.endswith("J: shape (7, 7), 1 of 49 entries wrong; first J[3, 2] (row 3): got 5, expected 0")


def test_a_difference_in_the_last_digits_is_visible() -> None:
    """Entries that would print alike get as many digits as tell them apart."""
    [part] = parts({"function": "residual", "expected": [1.0, 2.0], "got": [1.0, 2.0 + 1e-9]})
    assert part.wrong == {(1, 0)}
    left, right = part.entries()
    assert left[1] != right[1]


numbers = st.floats(-1e6, 1e6) | st.integers(-5, 5).map(float)


@given(st.lists(numbers, min_size=4, max_size=4), st.lists(numbers, min_size=4, max_size=4))
def test_two_different_arrays_never_look_alike(got: list[float], expected: list[float]) -> None:
    """Whatever the numbers, some entry is marked, and it reads differently on both sides."""
    [part] = parts({"function": "residual", "graph": GRAPH, "expected": expected, "got": got})
    assert bool(part.wrong) == (got != expected)
    left, right = part.entries()
    assert all(left[r][c] != right[r][c] for r, c in part.wrong)


@given(st.lists(numbers, min_size=3, max_size=3), st.lists(numbers, min_size=3, max_size=3))
def test_the_call_can_be_pasted(x: list[float], measurements: list[float]) -> None:
    """The text makes the same graph and the same state again, bit for bit."""
    fields = {**GRAPH, "measurements": measurements}
    seen: list[Any] = []
    scope = {"PoseGraph": PoseGraph, "np": np, "residual": lambda x, graph: seen.extend([x, graph])}
    exec(call_text({"function": "residual", "graph": fields, "x": x, "expected": [], "got": []}), scope)
    assert (seen[0] == np.array(x)).all()
    assert seen[0].dtype == np.float64
    assert seen[1] == PoseGraph(**fields)


@pytest.mark.parametrize(
    ("key", "value", "written"),
    [
        ("omega", [[2.0, 0.0], [0.0, 3.0]], "omega = np.diag([2.0, 3.0])"),
        ("omega", [[2.0, 1.0], [1.0, 3.0]], "omega = np.array([[2.0, 1.0], [1.0, 3.0]])"),
        ("omega", [[2.0, 0.0]], "omega = np.array([[2.0, 0.0]])"),
        ("x", [float("inf"), 1], "x = np.array([np.inf, 1])"),
        ("x", [0.0] * 30, "x = ...  # 30 entries, too many to show"),
        ("step", 0.5, "step = 0.5"),
        ("word", "a\x1bb", "word = a\\x1bb"),
    ],
)
def test_an_input_is_written_as_python(key: str, value: Any, written: str) -> None:
    """Diagonal matrices are short, long arrays are not printed, nothing foreign reaches the terminal raw."""
    assert call_text({"function": "", key: value}) == written


def test_a_ranging_is_written_as_python() -> None:
    """A record of another kind is made by its own name."""
    text = call_text({"function": "range_residual", "x": [0.5], "ranging": {"beacon": [1.0, 2.0], "poses": [0]}})
    assert text.splitlines() == [
        "ranging = Ranging(",
        "    beacon=[1, 2],",
        "    poses=[0],",
        ")",
        "x = np.array([0.5])",
        "range_residual(x, ranging)",
    ]


def test_an_exception_instead_of_two_arrays_is_said_once() -> None:
    """H and b are expected; what came instead stands above both."""
    text = counterexample_text({**WRONG_NORMAL, "got": "raised KeyError: 'x'"})
    assert text.count("KeyError") == 1
    assert "H:\n  expected" in text
    assert "b:\n  expected" in text


@pytest.mark.parametrize(
    ("value", "shown"),
    [(float("nan"), "nan"), (float("-inf"), "-inf"), (10**12, "1e+12"), (True, "True"), ("nan", "nan"), (-1e-20, "0")],
)
def test_any_entry_is_shown(value: Any, shown: str) -> None:
    """Whatever stands in a stored counterexample prints; rounding prints as 0."""
    assert number(value, dust=1e-15) == shown
