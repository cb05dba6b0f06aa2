"""The exam covers all that the contract allows: no family of graphs, states or matrices is in no case.

The families and their bounds are those of the contract, told here by tests/problems/features.py in other words than
the strategies', which draw them.
"""

import numpy as np
import pytest

from autograder.problems.draw import draw_ladder
from autograder.problems.graphs import MAX_RESIDUAL, WEIGHTS, loop_edges, tells, well_posed
from autograder.problems.ladders import GRAPHS, LOOPS, MATRICES, RANGINGS
from tests.problems.features import FEATURES, has

LADDERS = {ladder.name: ladder for ladder in (GRAPHS, MATRICES, LOOPS, RANGINGS)}
SEEDS = (0, 1)
EVERY_FEATURE = [(ladder, name) for ladder, names in FEATURES.items() for name in names]


@pytest.fixture(scope="module")
def exams():
    """All ladders, with 200 drawn cases, under two seeds: one list of cases a ladder and seed."""
    return {
        (name, seed): [case for found in draw_ladder(ladder, seed, 200).values() for case in found]
        for name, ladder in LADDERS.items()
        for seed in SEEDS
    }


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(("ladder", "feature"), EVERY_FEATURE)
def test_every_feature_is_met_in_five_cases(exams, ladder, feature, seed):
    """Whoever is wrong only there is seen, in five cases of every stage that climbs the ladder."""
    assert sum(has(ladder, feature, case) for case in exams[ladder, seed]) >= 5


@pytest.mark.parametrize(("ladder", "feature"), EVERY_FEATURE)
def test_every_feature_is_in_the_core_and_drawn(exams, ladder, feature):
    """It is there however few cases are drawn, and with other numbers under another seed."""
    core = [case for rung in LADDERS[ladder].rungs for case in rung.core]
    assert sum(has(ladder, feature, case) for case in core) >= 1
    everywhere = [sum(has(ladder, feature, case) for case in exams[ladder, seed]) for seed in SEEDS]
    assert max(everywhere) > sum(has(ladder, feature, case) for case in core)


@pytest.mark.parametrize("seed", SEEDS)
def test_judged_graphs_keep_the_bounds(exams, seed):
    """cond(H) <= 1e6, |x| <= 100 m, at most 100 poses and 200 m, variances from 1e-5 to 1000 m^2."""
    assert all(well_posed(*case) for case in exams["graphs", seed])
    assert all(well_posed(x, graph) for states, graph in exams["loops", seed] for x in states)


@pytest.mark.parametrize("seed", SEEDS)
def test_judged_matrices_keep_the_bounds(exams, seed):
    """Omega is diagonal with weights from 1e-3 to 1e5, |f| is at most 1000, and so is no J without an entry."""
    for J, omega, f in exams["matrices", seed]:
        weights = np.diag(omega)
        assert np.array_equal(omega, np.diag(weights))
        assert WEIGHTS[0] <= weights.min()
        assert weights.max() <= WEIGHTS[1]
        assert np.abs(f).max() <= MAX_RESIDUAL
        assert J.any()


@pytest.mark.parametrize("seed", SEEDS)
def test_every_loop_tells(exams, seed):
    """Each case of the loops has a loop, two starts that differ, and a minimum that every measurement on it moves."""
    for states, graph in exams["loops", seed]:
        assert loop_edges(graph)
        assert tells(states, graph)
