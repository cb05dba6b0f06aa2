"""Variants are sharp: a known mistake that can change the answer does change it."""

from __future__ import annotations

import importlib
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from assignment.posegraph import PoseGraph
from autograder.problems.discriminating import Demand, Mistake, Sharpness, mistaken, sharpness, unseen
from autograder.problems.families import family
from autograder.problems.ledger import Ledger
from autograder.problems.secret import Secret
from reference_solution import slam1d

RIGHT: dict[str, Callable[..., Any]] = {
    name: getattr(slam1d, name) for name in ("residual", "jacobian", "information_matrix", "normal_equations")
}
SECRET = Secret(b"0123456789abcdef")


def weights(rule: Callable[[np.ndarray], np.ndarray]) -> Callable[[PoseGraph], np.ndarray]:
    """Weigh the edges by another rule than 1/variance; the prior keeps its weight."""

    def information_matrix(graph: PoseGraph) -> np.ndarray:
        return np.diag(np.concatenate([rule(graph.edge_variances), 1 / graph.prior_variances]))

    return information_matrix


def loop_rows(change: Callable[[np.ndarray, PoseGraph], np.ndarray]) -> Callable[[np.ndarray, PoseGraph], np.ndarray]:
    """Change the residual's rows of edges that are no step of the chain."""

    def residual(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
        f = slam1d.residual(x, graph)
        loop = np.flatnonzero(np.append(graph.edges[:, 1] - graph.edges[:, 0] != 1, np.zeros(len(graph.priors), bool)))
        f[loop] = change(f, graph)[loop]
        return f

    return residual


WEIGHTS: dict[str, Mistake] = {
    name: mistaken(RIGHT, "information_matrix", weights(rule))
    for name, rule in {
        "covariance": lambda v: v,
        "inverse standard deviation": lambda v: v**-0.5,
        "squared again": lambda v: v**-2.0,
        "identity": np.ones_like,
        "first for all": lambda v: np.full_like(v, 1 / v[0]),
        "last as the first": lambda v: np.append(1 / v[:-1], 1 / v[0]),
    }.items()
}
LOOPS: dict[str, Mistake] = {
    name: mistaken(RIGHT, "residual", loop_rows(change))
    for name, change in {
        "measurement dropped": lambda f, graph: f - np.append(graph.measurements, np.zeros(len(graph.priors))),
        "without sign": lambda f, _graph: np.abs(f),
        "opposite sign": lambda f, _graph: -f,
        "one decimal": lambda f, _graph: f.round(1),
    }.items()
}


@pytest.mark.parametrize("letter", ["A", "B", "C", "D", "L"])
def test_every_weighting_and_loop_mistake_shows(letter: str) -> None:
    """On 200 variants of every family with unequal variances each of these mistakes changes the answer."""
    variants = Ledger().extend(SECRET, "2026S", {f"s{k}": family(letter) for k in range(200)})
    assert {found for variant in variants for found in unseen(variant, WEIGHTS | LOOPS)} == set()


def test_equal_variances_hide_weighting_mistakes() -> None:
    """Family W shows the mistakes about the loop and none about weights, and its report says so."""
    seen = sharpness(family("W"), WEIGHTS | LOOPS)
    assert set(seen.shown) == set(LOOPS)
    assert set(seen.blind) == set(WEIGHTS)
    text = seen.text()
    assert text.startswith("Family W shows 4 of 10 known mistakes.")
    assert all(f"  {name}" in text for name in WEIGHTS)
    assert Sharpness("A", {"x": 1.0}).text() == "Family A shows 1 of 1 known mistakes."


def test_a_variant_that_hides_a_mistake_is_drawn_again() -> None:
    """A mistake that shows on half of the draws shows on every released variant."""

    def half(graph: PoseGraph, start: np.ndarray) -> np.ndarray:
        right = start + slam1d.gauss_newton_step(start, graph)
        return right + (graph.measurements[0] > 0)

    demand = Demand([family("A")], {"half": half})
    variants = Ledger().extend(SECRET, "2026S", {f"s{k}": family("A") for k in range(30)}, accept=demand.accept)
    assert all(variant.graph.measurements[0] > 0 for variant in variants)


def test_the_right_functions_are_never_seen() -> None:
    """What is right gives the right answer: as a stage of its own, and as the step."""
    (variant,) = Ledger().extend(SECRET, "2026S", {"s1": family("C")})
    right = {name: mistaken(RIGHT, name, function) for name, function in RIGHT.items()}
    right["step"] = mistaken(RIGHT, "gauss_newton_step", slam1d.gauss_newton_step)
    assert unseen(variant, right) == tuple(right)


def test_whatever_breaks_is_seen() -> None:
    """An exception, another shape, no number, or luck with a singular system is not the right answer."""
    (variant,) = Ledger().extend(SECRET, "2026S", {"s1": family("A")})

    def no_prior(x: np.ndarray, graph: PoseGraph) -> np.ndarray:
        J = slam1d.jacobian(x, graph)
        J[-1] = 0
        return J

    def lucky(graph: PoseGraph, start: np.ndarray) -> np.ndarray:
        right = np.array([float(value) for value in variant.x1])
        return right + (start - variant.start) * 1e9

    broken: dict[str, Mistake] = {
        "raises": mistaken(RIGHT, "residual", lambda _x, _graph: 1 / 0),
        "short": lambda _graph, start: start[:2],
        "nothing": lambda _graph, start: start * np.nan,
        "no number": lambda _graph, start: np.array(["x"] * len(start)),
        "singular": mistaken(RIGHT, "jacobian", no_prior),
        "lucky": lucky,
    }
    assert unseen(variant, broken) == ()


def known_mistakes() -> dict[str, Mistake]:
    """Wire the slips of the stages as a caller does."""
    return {
        f"{stage}.{slip.identifier}": mistaken(RIGHT, stage, slip.function)
        for stage in (*RIGHT, "gauss_newton_step")
        for slip in importlib.import_module(f"autograder.stages.slips.{stage}").SLIPS
    }


@pytest.mark.parametrize("letter", ["W", "A", "B", "C", "D", "L"])
def test_variants_show_the_catalogue(letter: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every catalogued mistake that a family can show changes the answer on each variant that is released."""
    monkeypatch.setattr("autograder.problems.discriminating.PROBES", 12)
    mistakes = known_mistakes()
    chosen = family(letter)
    can = sharpness(chosen, mistakes).shown
    assert len(can) > 50
    demand = Demand([chosen, family("E")], mistakes)
    assert demand.text() == sharpness(chosen, mistakes).text() + "\n"
    wanted = {f"s{k}": chosen for k in range(12)}
    variants = Ledger().extend(SECRET, "2026S", wanted, accept=demand.accept)
    assert {found for variant in variants for found in unseen(variant, mistakes)}.isdisjoint(can)
