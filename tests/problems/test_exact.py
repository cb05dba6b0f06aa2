"""Pose graphs in fractions, against a witness that shares no code with them."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from assignment.posegraph import PoseGraph
from autograder.problems.exact import ExactGraph, decimal, eliminate, floats
from autograder.problems.families.worked_example import worked_example
from tests.witness import exact_normal_equations, exact_problem, exact_solve

SHORT = st.integers(-999, 999).map(lambda cents: cents / 100)
VARIANCES = st.sampled_from([0.001, 0.01, 0.02, 0.04, 0.05, 0.5, 3.0])


@st.composite
def graphs(draw: st.DrawFn) -> PoseGraph:
    """Draw a connected graph with edges in any order and direction, and one prior or more."""
    n = draw(st.integers(2, 6))
    pairs = [(draw(st.integers(0, j - 1)), j) for j in range(1, n)]
    pairs += draw(st.lists(st.tuples(st.integers(0, n - 1), st.integers(0, n - 1)).filter(lambda p: p[0] != p[1])))[:3]
    edges = [pair[::-1] if draw(st.booleans()) else pair for pair in draw(st.permutations(pairs))]
    priors = draw(st.lists(st.integers(0, n - 1), min_size=1, max_size=2))
    return PoseGraph(
        n,
        np.array(edges),
        np.array([draw(SHORT) for _ in edges]),
        np.array([draw(VARIANCES) for _ in edges]),
        np.array(priors),
        np.array([draw(SHORT) for _ in priors]),
        np.array([draw(VARIANCES) for _ in priors]),
    )


@given(graphs(), st.data())
@settings(max_examples=60)
def test_everything_agrees_with_the_witness(graph: PoseGraph, data: st.DataObject) -> None:
    """Residual, H, b and the solution are those of the witness, exactly."""
    x = [data.draw(SHORT) for _ in range(graph.n_poses)]
    exact, state = ExactGraph.of(graph), [Fraction(repr(value)) for value in x]
    f, J, weights = exact_problem(x, graph)
    H, b = exact_normal_equations(f, J, weights)
    assert list(exact.residual(state)) == f
    assert exact.normal_equations(state) == (H, b)
    step = exact_solve(H, [-entry for entry in b])
    assert list(exact.solution()) == [before + change for before, change in zip(state, step, strict=True)]
    assert not any(exact.gradient(exact.solution()))


@given(graphs())
@settings(max_examples=60)
def test_a_graph_comes_back_from_floats(graph: PoseGraph) -> None:
    """Rounding to float64 and reading the short decimals again loses nothing."""
    assert ExactGraph.of(graph).posegraph() == graph


@given(graphs())
@settings(max_examples=60)
def test_dead_reckoning_follows_the_contract(graph: PoseGraph) -> None:
    """Dead reckoning in fractions is that of PoseGraph, up to float noise."""
    np.testing.assert_allclose(floats(ExactGraph.of(graph).dead_reckoning()), graph.dead_reckoning(), atol=1e-12)


def test_the_worked_example_is_exact() -> None:
    """The worked example's answer is (0, 1, 1.9, 2.9, 0.1), with H[3, 3] = 200."""
    exact = ExactGraph.of(worked_example())
    assert [decimal(value) for value in exact.solution()] == ["0", "1", "1.9", "2.9", "0.1"]
    H, b = exact.normal_equations(exact.dead_reckoning())
    assert H[3][3] == 200
    assert b == [-50, 0, 0, 0, 50]


def _without_prior(**changes: Any) -> ExactGraph:
    fields = {"priors": (), "prior_means": (), "prior_variances": ()} | changes
    return ExactGraph(3, ((0, 1), (1, 2)), (Fraction(1), Fraction(2)), (Fraction(1), Fraction(1)), **fields)


def test_a_problem_without_a_prior_is_refused() -> None:
    """Without a prior there is no start, and H has no pivot in its last column."""
    with pytest.raises(ValueError, match="every connected part must have a prior, got none for the part of pose 0"):
        _without_prior().dead_reckoning()
    with pytest.raises(ValueError, match="the matrix must be regular, got no pivot in column 2"):
        _without_prior().solution()


def test_elimination_exchanges_rows() -> None:
    """A zero on the diagonal is no obstacle."""
    assert eliminate([[Fraction(0), Fraction(1)], [Fraction(2), Fraction(0)]], [Fraction(3), Fraction(4)]) == (2, 3)


@given(st.integers(-(10**9), 10**9), st.integers(0, 9))
def test_a_decimal_is_written_in_full(digits: int, places: int) -> None:
    """The text of a decimal reads back as the same number and has no digit too many."""
    value = Fraction(digits, 10**places)
    text = decimal(value)
    assert Fraction(text) == value
    assert not ("." in text and text.endswith("0"))
    assert text not in {"-0", ""}


def test_what_is_no_decimal_is_a_quotient() -> None:
    """A third is written as one."""
    assert decimal(Fraction(-2, 6)) == "-1/3"
