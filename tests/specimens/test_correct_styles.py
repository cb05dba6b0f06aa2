"""Every correct style agrees with the reference, up to the convention or the form that its first line states."""

from __future__ import annotations

import importlib
import re
import sys
import warnings
from pathlib import Path
from typing import Any, get_args

import numpy as np
import pytest

import assignment.posegraph
from assignment.posegraph import PoseGraph
from autograder.audit.expectation import KINDS, Expected, expected
from autograder.stages.slips.submission import FUNCTIONS
from autograder.verdicts import StageStatus
from reference_solution import slam1d
from tests.specimens.first_line import code, executed, submissions
from tests.stages import graph_pool

STAGES = (*FUNCTIONS, "second_step")
STYLES = {*range(1, 26), *range(28, 32), *range(33, 39), 40, 41, 43}  # of the catalogue; the others are not right
ALL = submissions("correct", "equivalent", "wrong", "disputed")
CASES = graph_pool.pool(beyond=False)
CLOSE = {
    "style_41_central_differences": 1e-7,
    "harmless_guards": 1e-6,
    "forward_difference_1e_9": 1e-4,
    "style_42_float32": 1e-3,
}


@pytest.fixture(autouse=True)
def posegraph_beside(monkeypatch: pytest.MonkeyPatch) -> None:
    """A submission finds the problem model under the name that students use."""
    monkeypatch.setitem(sys.modules, "posegraph", assignment.posegraph)


def verdict(path: Path) -> Expected:
    """Return the verdict in the first line of a specimen."""
    return expected(code(path)[0].splitlines()[0])


def answer(function: Any, *arguments: Any) -> Any:
    """Call a function of a specimen on copies of the arguments; np.matrix warns that it is old."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", PendingDeprecationWarning)
        return function(*(value.copy() if isinstance(value, np.ndarray) else value for value in arguments))


def flat(value: Any) -> np.ndarray:
    """Return numbers as one vector of float64."""
    return np.asarray(value, dtype=np.float64).ravel()


def assert_close(path: Path, got: np.ndarray, wanted: np.ndarray) -> None:
    """The numbers agree, relative to the largest one."""
    scale = max(1.0, float(np.abs(wanted).max()))
    np.testing.assert_allclose(got / scale, wanted / scale, rtol=0, atol=CLOSE.get(path.stem, 1e-9))


def keys(f: np.ndarray, J: np.ndarray, omega: np.ndarray) -> np.ndarray:
    """Return the factors (f, J, Omega) a row, in an order and with signs that do not depend on the convention."""
    first = np.take_along_axis(J, np.argmax(np.abs(J) > 0.5, axis=1)[:, None], axis=1)
    rows = np.column_stack([J * first, f[:, None] * first, np.diag(omega)])
    return rows[np.lexsort(rows.T.round(6))]


@pytest.mark.parametrize("path", ALL, ids=lambda path: path.stem)
def test_the_first_line_states_a_verdict(path: Path) -> None:
    """The first line names known stages, statuses, slips and remarks."""
    found = verdict(path)
    assert found.others in get_args(StageStatus)
    assert set(found.remarks) <= KINDS
    for stage, (status, slip, _) in found.stages.items():
        assert stage in STAGES
        assert status in get_args(StageStatus)
        slips = importlib.import_module(f"autograder.stages.slips.{stage}").SLIPS
        assert slip in {"", *(entry.identifier for entry in slips)}


def test_every_style_of_the_catalogue_is_here() -> None:
    """Each correct style has a file, and each that contradicts the contract has one elsewhere."""
    numbers = {path: int(match[1]) for path in ALL if (match := re.match(r"style_(\d+)_", path.stem))}
    assert {n for path, n in numbers.items() if path.parent.name in ("correct", "equivalent")} == STYLES
    assert {n for path, n in numbers.items() if path.parent.name in ("wrong", "disputed")} == set(range(1, 45)) - STYLES


@pytest.mark.parametrize("path", submissions("correct", "equivalent"), ids=lambda path: path.stem)
def test_a_correct_style_has_full_marks(path: Path) -> None:
    """The first line of a correct style takes no point; only those of another convention speak of rows."""
    found = verdict(path)
    assert (found.stages, found.others) == ({}, "passed")
    assert bool({"row_order", "row_sign"} & set(found.remarks)) == (path.parent.name == "equivalent")


@pytest.mark.parametrize("path", submissions("correct", "disputed"), ids=lambda path: path.stem)
def test_a_correct_style_agrees_with_the_reference(path: Path) -> None:
    """f, J, Omega and dx are the reference's numbers, and H and b for any real J and f."""
    student = executed(path)
    for x, graph in CASES:
        for name in ("residual", "jacobian", "gauss_newton_step"):
            assert_close(path, flat(answer(student[name], x, graph)), flat(getattr(slam1d, name)(x, graph)))
        assert_close(path, flat(answer(student["information_matrix"], graph)), flat(slam1d.information_matrix(graph)))
    for system in graph_pool.systems(1, 2, 4, 7, each=3):
        for got, wanted in zip(
            answer(student["normal_equations"], *system), slam1d.normal_equations(*system), strict=True
        ):
            assert_close(path, flat(got), flat(wanted))


@pytest.mark.parametrize("path", submissions("equivalent"), ids=lambda path: path.stem)
def test_an_equivalent_style_is_the_same_least_squares(path: Path) -> None:
    """Its factors are the reference's up to order and sign, the same for f, J and Omega, and dx is the same."""
    student = executed(path)
    differs = False
    for x, graph in CASES:
        f, J, omega = factors(student, x, graph)
        right = factors(vars(slam1d), x, graph)
        np.testing.assert_allclose(keys(f, J, omega), keys(*right), atol=1e-9)
        assert_close(path, flat(student["gauss_newton_step"](x, graph)), slam1d.gauss_newton_step(x, graph))
        differs |= not np.allclose(J, right[1])
    assert differs


def factors(student: dict[str, Any], x: np.ndarray, graph: PoseGraph) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return f, J and Omega of a submission."""
    return student["residual"](x, graph), student["jacobian"](x, graph), student["information_matrix"](graph)


# Their slip beside another convention: the rows of the priors come first, or have the other sign.
OTHER_ROWS = {"priors_first_without_mean", "whitened_and_turned"}
WRONG = [path for path in submissions("wrong") if "forbidden" not in code(path)[0]]


@pytest.mark.parametrize("path", WRONG, ids=lambda path: path.stem)
def test_a_wrong_style_equals_the_slips_that_it_names(path: Path) -> None:
    """Where a slip is named the outputs are the slip's; where a stage passes they are the reference's.

    A slip that is known by the pattern of its error has other digits than a student's; that one differs is seen.
    """
    student = executed(path)
    for stage in FUNCTIONS:
        status, name, _ = verdict(path).stages.get(stage, ("", "", False))
        if status == "missing" or (status and not name):  # not there, or wrong in a way that has no name
            continue
        entry = next((each for each in slips_of(stage) if each.identifier == name), None)
        if verdict(path).others == "missing" and not status:
            continue
        calls = [given(stage, call) for call in (graph_pool.systems(2, 4) if stage == "normal_equations" else CASES)]
        pairs = [(attempted(student[stage], call), attempted(model(stage, entry), call)) for call in calls]
        if entry is not None and entry.pattern is not None:
            right = [attempted(getattr(slam1d, stage), call) for call in calls]
            assert any(not equal(got, wanted) for (got, _), wanted in zip(pairs, right, strict=True))
            continue
        turned = sorted_rows if path.stem in OTHER_ROWS and entry is not None else lambda values: values
        for got, wanted in pairs:
            assert equal(turned(got), turned(wanted))


def given(stage: str, call: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return the arguments of a stage."""
    return call[1:] if stage == "information_matrix" else call


def model(stage: str, slip: Any) -> Any:
    """Return the function that a specimen should equal."""
    return getattr(slam1d, stage) if slip is None else slip.function


def attempted(function: Any, call: tuple[Any, ...]) -> list[np.ndarray] | None:
    """Return the arrays of an answer; None where it is an exception."""
    try:
        value = answer(function, *call)
    except (IndexError, ValueError, np.linalg.LinAlgError):
        return None
    return [np.asarray(each, dtype=np.float64) for each in (value if isinstance(value, tuple) else (value,))]


def equal(got: list[np.ndarray] | None, wanted: list[np.ndarray] | None) -> bool:
    """Whether two answers are one, up to rounding; a column is a vector."""
    if got is None or wanted is None:
        return got is wanted
    return all(
        one.size == other.size and np.abs(one.ravel() - other.ravel()).max() <= 1e-9 * max(1.0, np.abs(other).max())
        for one, other in zip(got, wanted, strict=True)
    )


def sorted_rows(values: list[np.ndarray] | None) -> list[np.ndarray] | None:
    """Leave out the order and the signs of rows."""
    if values is None:
        return None
    rows = [np.abs(each.reshape(len(each), -1)) for each in values]
    return [each[np.lexsort(each.T.round(6))] for each in rows]


def slips_of(stage: str) -> Any:
    """Return the slips of a stage."""
    return importlib.import_module(f"autograder.stages.slips.{stage}").SLIPS
