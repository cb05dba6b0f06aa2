"""A mistake that one family of the domain shows is caught, and a guard that changes nothing is not."""

from __future__ import annotations

import numpy as np
import pytest

from autograder.problems.draw import draw_ladder
from autograder.stages.catalogue import all_stages
from reference_solution import slam1d
from tests.stages.answering import verdicts
from tests.stages.mistakes import MISTAKES, solved

STAGES = {stage.name: stage for stage in all_stages()}
ALL = [(stage, rung, name) for (stage, rung), found in MISTAKES.items() for name in found]


def guarded(x, graph, guard):
    """Solve with something small added to H."""
    return solved(x, graph, lambda H, b: np.linalg.solve(H + guard(H) * np.eye(len(b)), b))


def equations(change):
    """Form H and b, and change H."""

    def found(J, omega, f):
        H, b = slam1d.normal_equations(J, omega, f)
        return change(H), b

    return found


def variances(graph):
    """Return those of the edges, then those of the priors."""
    return np.concatenate([graph.edge_variances, graph.prior_variances])


HARMLESS = {
    "variances and 1e-12": ("information_matrix", lambda graph: np.diag(1.0 / (variances(graph) + 1e-12))),
    "weights off by 1e-9": ("information_matrix", lambda graph: np.diag((1.0 + 1e-9) / variances(graph))),
    "1e-9 beside the diagonal": (
        "information_matrix",
        lambda graph: np.diag(1.0 / variances(graph)) + 1e-9 / variances(graph).min() * (1.0 - np.eye(graph.n_factors)),
    ),
    "H and 1e-9": ("normal_equations", equations(lambda H: H + 1e-9 * np.eye(len(H)))),
    "H and 1e-9 of its largest": ("normal_equations", equations(lambda H: H + 1e-9 * np.abs(H).max())),
    "step with 1e-9": ("gauss_newton_step", lambda x, graph: guarded(x, graph, lambda _: 1e-9)),
    "step with 1e-9 of the largest": (
        "gauss_newton_step",
        lambda x, graph: guarded(x, graph, lambda H: 1e-9 * H.max()),
    ),
    "second step with 1e-9": ("second_step", lambda x, graph: guarded(x, graph, lambda _: 1e-9)),
    "second step with 1e-9 of the largest": (
        "second_step",
        lambda x, graph: guarded(x, graph, lambda H: 1e-9 * H.max()),
    ),
}


@pytest.mark.parametrize(("stage", "rung", "name"), ALL)
def test_the_core_shows_it(stage, rung, name):
    """However few cases are drawn, and though it is right on the worked example."""
    wrong = {}
    for each in STAGES[stage].ladder.rungs:
        if rung in ("", each.name):
            wrong[each.name] = not verdicts(
                STAGES[stage].facet(each.name), each.core, MISTAKES[stage, rung][name]
            ).all()
    assert any(wrong.values())
    assert not wrong.get("worked_example")


@pytest.mark.parametrize("name", HARMLESS)
def test_a_harmless_guard_costs_nothing(name):
    """H within 1e-9 of its largest entry and weights within 1e-9 pass everywhere, where 0 is right too."""
    stage, function = HARMLESS[name]
    for found in draw_ladder(STAGES[stage].ladder, 0, 100).values():
        assert verdicts(STAGES[stage], found, function).all()
