"""Every slip is wrong, differs from every other slip of its stage, and has words that teach."""

from __future__ import annotations

import importlib
import inspect
import itertools
import re
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest

from autograder.stages.base import Slip
from autograder.stages.slips.submission import FUNCTIONS, submission_text
from reference_solution import slam1d
from tests.stages import graph_pool

STAGES = (*FUNCTIONS, "second_step")
FUNCTION = {**{name: name for name in FUNCTIONS}, "second_step": "gauss_newton_step"}

# These are close to the truth by nature: how far off they must be somewhere, relative to the largest entry.
BY_NATURE = {
    "residual_rounded": 1e-5,
    "step_rounded": 1e-5,
    "rounded_step_stops_short": 1e-5,
    "step_in_single_precision": 1e-8,
    "residual_in_single_precision": 1e-8,
    "information_in_single_precision": 1e-8,
    "normal_equations_in_single_precision": 1e-8,
    "single_precision_leaves_a_rest": 1e-8,
    "difference_step_too_small": 1e-7,
    "normal_equations_rounded": 1e-6,
    "h_regularised": 1e-5,
}
SAME = 1e-9


def slips(stage: str) -> tuple[Slip, ...]:
    """Return the slips of a stage."""
    found: tuple[Slip, ...] = importlib.import_module(f"autograder.stages.slips.{stage}").SLIPS
    return found


ALL = [(stage, slip) for stage in STAGES for slip in slips(stage)]
EVERY_SLIP = pytest.mark.parametrize(("stage", "slip"), ALL, ids=[f"{stage}-{slip.identifier}" for stage, slip in ALL])


def cases(stage: str, *sizes: int) -> Sequence[Any]:
    """Return the arguments of the calls for a stage: a pool, or small random cases of the given sizes."""
    if stage == "normal_equations":
        return graph_pool.systems(*sizes) if sizes else graph_pool.systems(1, 2, 3, 4, 5, 7, each=4)
    drawn = graph_pool.cases(*sizes) if sizes else graph_pool.pool()
    return [(graph,) for _, graph in drawn] if stage == "information_matrix" else drawn


def answers(stage: str, function: Callable[..., Any], arguments: Any) -> list[np.ndarray]:
    """Call a function as its stage does: once, but the second step from two starts and again from where they lead."""
    if stage == "second_step":
        x, graph = arguments
        found = []
        for start in (x, x[::-1] + 1.0):
            dx = np.asarray(function(start.copy(), graph))
            found += [dx, np.asarray(function(start + np.resize(dx, len(start)), graph))]
        return found
    try:
        returned = function(*(value.copy() if isinstance(value, np.ndarray) else value for value in arguments))
    except IndexError:  # it answers nothing
        return [np.zeros(0)]
    return [np.asarray(part) for part in (returned if isinstance(returned, tuple) else (returned,))]


def outputs(stage: str, function: Callable[..., Any], *sizes: int) -> list[np.ndarray]:
    """Collect all answers of a function on the cases of a stage."""
    return [part for arguments in cases(stage, *sizes) for part in answers(stage, function, arguments)]


def distance(one: list[np.ndarray], other: list[np.ndarray]) -> float:
    """Return the largest difference between answers, relative to the largest entry of the other; inf for shapes."""
    worst = 0.0
    for a, b in zip(one, other, strict=True):
        if a.shape != b.shape or not (np.isfinite(a) == np.isfinite(b)).all():
            return np.inf
        finite = np.isfinite(a)
        if finite.any():
            difference = np.abs(a[finite].astype(float) - b[finite].astype(float)).max()
            worst = max(worst, float(difference / max(np.abs(b[finite]).max(), 1e-3)))
    return worst


@EVERY_SLIP
def test_a_slip_is_wrong(stage: str, slip: Slip) -> None:
    """A slip differs from the reference somewhere on the pool, and clearly unless it is small by nature."""
    right = outputs(stage, getattr(slam1d, FUNCTION[stage]))
    assert distance(outputs(stage, slip.function), right) > BY_NATURE.get(slip.identifier, 1e-3)


@pytest.mark.parametrize("stage", STAGES)
def test_slips_of_a_stage_differ_from_each_other(stage: str) -> None:
    """No two slips of a stage give the same answers on the pool."""
    found = {slip.identifier: outputs(stage, slip.function) for slip in slips(stage)}
    same = [(a, b) for a, b in itertools.combinations(found, 2) if distance(found[a], found[b]) <= SAME]
    assert not same, f"merge these: {same}"


@EVERY_SLIP
def test_a_slip_shows_from_its_smallest_size_on(stage: str, slip: Slip) -> None:
    """`minimum_poses` is exact: wrong on some case of this size, right on all smaller ones."""
    right = getattr(slam1d, FUNCTION[stage])
    size = slip.minimum_poses
    assert distance(outputs(stage, slip.function, size), outputs(stage, right, size)) > SAME
    for smaller in range(1 if stage == "normal_equations" else 2, size):
        assert distance(outputs(stage, slip.function, smaller), outputs(stage, right, smaller)) <= SAME


@pytest.mark.parametrize("stage", STAGES)
def test_slips_have_words_that_teach(stage: str) -> None:
    """Names and hints are whole sentences, and no two slips of a stage share one."""
    found = slips(stage)
    for field in ("identifier", "name", "hint"):
        texts = [getattr(slip, field) for slip in found]
        assert len(set(texts)) == len(texts)
    for slip in found:
        assert re.fullmatch(r"[a-z][a-z0-9_]+", slip.identifier)
        assert re.fullmatch(r"[A-Z][^\n]*\.", slip.name)
        assert re.fullmatch(r"(?:[A-Z]|[fb]\b).*[.?]", slip.hint)
        assert len(slip.name) <= 110
        assert 40 <= len(slip.hint) <= 200


def test_identifiers_are_unique_across_stages() -> None:
    """An identifier names one slip, so that a report needs no stage beside it."""
    identifiers = [slip.identifier for _, slip in ALL]
    assert len(set(identifiers)) == len(identifiers)


@EVERY_SLIP
def test_a_hint_holds_no_code(stage: str, slip: Slip) -> None:
    """A hint leads to the idea: it holds no line of the reference and no code at all."""
    for line in inspect.getsource(slam1d).splitlines():
        code = line.strip().removeprefix("return ")
        assert len(code) < 12 or code not in slip.hint
    assert not re.search(r"np\.|[@\[\]{}*]|=|\w\(|\.T\b|\*\*", slip.hint)


@EVERY_SLIP
def test_a_slip_stands_by_itself_as_a_submission(stage: str, slip: Slip) -> None:
    """The text of a slip as a submission runs alone and gives the same answers."""
    namespace: dict[str, Any] = {"__name__": "slam1d"}
    exec(compile(submission_text(slip, FUNCTION[stage]), slip.identifier, "exec"), namespace)
    alone = outputs(stage, namespace[FUNCTION[stage]])
    assert distance(alone, outputs(stage, slip.function)) <= SAME


def test_every_mistake_of_the_catalogue_has_a_slip() -> None:
    """All of the 68 tabled mistakes are here but those that concern reported values and a changed input."""
    tabled = {
        "R": "1 2 3 4 5 6 8 9 12 14 15 17 18 21 22 23",
        "J": "1 2 3 4 6 7 10 11",
        "W": "1 2 3 4 5 6 7 8 9 10 12",
        "H": "1 2 3 4 5 8 11 13 15 16 17 18",
        "S": "1 4 5 9 10 11 12 13 15 16 17 18 20 21 24",
        "T": "1 5",
    }
    wanted = {letter + number for letter, numbers in tabled.items() for number in numbers.split()}
    assert {name for _, slip in ALL for name in slip.catalogue.split(", ") if name} == wanted
