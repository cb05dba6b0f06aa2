"""The drawn cases: enough, distinct, simplest first, inside the bounds, the same for the same seed."""

import ast
import inspect
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assignment.posegraph import PoseGraph
from autograder.problems import chance, drawn_systems, strategies
from autograder.problems.cases import key, simplicity
from autograder.problems.draw import draw_ladder
from autograder.problems.graphs import loop_edges, nudged
from autograder.problems.ladders import GRAPHS, LOOPS, MATRICES
from autograder.problems.strategies import STRATEGIES, square
from reference_solution import slam1d

LADDERS = {ladder.name: ladder for ladder in (GRAPHS, MATRICES, LOOPS)}


@pytest.fixture(scope="module")
def drawn():
    """All ladders with 200 drawn cases."""
    return {name: draw_ladder(ladder, 0, 200) for name, ladder in LADDERS.items()}


@pytest.mark.parametrize("name", LADDERS)
def test_two_hundred_distinct_cases(drawn, name):
    """At least 200 drawn cases stand beside the core, and no two cases of a ladder are equal."""
    cases = [case for found in drawn[name].values() for case in found]
    core = sum(len(rung.core) for rung in LADDERS[name].rungs)
    assert len(cases) == 200 + core
    assert len({key(case) for case in cases}) >= 200


@pytest.mark.parametrize("name", LADDERS)
def test_simplest_first(drawn, name):
    """The drawn cases of a rung are ordered from simple to rich."""
    for rung in LADDERS[name].rungs:
        sizes = [simplicity(case)[:2] for case in drawn[name][rung.name][len(rung.core) :]]
        assert sizes == sorted(sizes)


@pytest.mark.parametrize("name", LADDERS)
def test_the_core_is_always_there(name):
    """However few cases are drawn, under whatever seed, the core is part of every rung."""
    few = draw_ladder(LADDERS[name], 7, 1)
    for rung in LADDERS[name].rungs:
        assert few[rung.name][: len(rung.core)] == rung.core


def test_another_seed_draws_other_cases():
    """The seed decides the draw, and nothing else does."""
    once, again, other = (draw_ladder(MATRICES, seed, 20) for seed in (1, 1, 2))
    digests = [[key(case) for found in drawn.values() for case in found] for drawn in (once, again, other)]
    assert digests[0] == digests[1]
    assert digests[0] != digests[2]


@given(st.sampled_from(["single_loops", "loops_in_graphs"]).flatmap(lambda rung: STRATEGIES["loops"][rung]))
def test_a_square_holds_four_loops_that_differ_in_two_measurements(case):
    """Its loops share the first state, and a changed measurement leads from one to the next, and back."""
    loops = square(case)
    assert len({key(each) for each in loops}) == 4
    assert all(np.abs(states[0] - states[1]).max() >= 1.0 for states, _ in loops)
    assert all((states[0] == case[0][0]).all() for states, _ in loops)
    graphs = [graph for _, graph in loops]
    for graph in graphs:
        beside = {nudged(graph, row) for row in loop_edges(graph)}
        assert len(beside & set(graphs)) == 2


def test_the_ladder_of_graphs_is_rich(drawn):
    """Backward, doubled and interior edges, other priors, two priors, decades of variances: all are met."""
    graphs = [graph for found in drawn["graphs"].values() for _, graph in found]
    assert any((graph.edges[:, 0] > graph.edges[:, 1]).any() for graph in graphs)
    assert any(len({frozenset(pair) for pair in graph.edges.tolist()}) < len(graph.edges) for graph in graphs)
    assert any(len(graph.priors) == 2 for graph in graphs)
    assert any(graph.priors[0] != 0 for graph in graphs)
    assert any(graph.prior_means[0] != 0 for graph in graphs)
    assert any(graph.edge_variances.max() / graph.edge_variances.min() >= 1000 for graph in graphs)
    assert {2, 100} <= {graph.n_poses for graph in graphs}


def test_no_case_gives_another_stage_away(drawn):
    """No J, Omega or f that `normal_equations` is given belongs to a graph of another stage."""
    given = {tuple(array.ravel()) for found in drawn["matrices"].values() for case in found for array in case}
    states = [case for found in drawn["graphs"].values() for case in found]
    states += [(x, graph) for found in drawn["loops"].values() for xs, graph in found for x in xs]
    for x, graph in states:
        secret = (slam1d.residual(x, graph), slam1d.jacobian(x, graph), slam1d.information_matrix(graph))
        assert not any(tuple(array.ravel()) in given for array in secret)


def test_draws_do_not_depend_on_literals_of_local_modules():
    """Strategies draw integers within +-99 only, which Hypothesis never replaces by literals that it finds in code."""
    source = "".join(inspect.getsource(module) for module in (chance, drawn_systems, strategies))
    bounds = re.findall(r"integers\(([^()]*)\)", source)
    assert bounds
    for text in bounds:
        assert all(abs(int(number)) <= 99 for number in re.findall(r"-?\d+", text))
    assert "st.floats" not in source


def test_every_rung_with_a_share_has_a_strategy():
    """A rung that draws has a strategy of its name, and no strategy is left over."""
    for name, ladder in LADDERS.items():
        assert {rung.name for rung in ladder.rungs if rung.share} == set(STRATEGIES[name])


def test_loop_edges_of_a_tree_are_none():
    """A walk without a closure has no loop."""
    assert loop_edges(PoseGraph(3, [(0, 1), (1, 2)], [1, 1], [1, 1], [0], [0], [1])) == []


def test_no_literal_is_taken_for_a_draw():
    """Hypothesis mixes literals of local modules into its draws: none of bytes has the length of a draw."""
    root = Path(chance.__file__).parents[2]
    literals = [
        (path.name, node.value)
        for package in ("assignment", "autograder", "reference_solution")
        for path in (root / package).rglob("*.py")
        if "specimens" not in path.parts
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Constant) and isinstance(node.value, bytes)
    ]
    assert len(literals) > 50
    assert [found for found in literals if len(found[1]) == chance.BYTES] == []


@given(st.data())
def test_every_value_of_a_table_is_drawn(data):
    """An array holds values of its table and nothing else, however long it is."""
    table, count = data.draw(st.sampled_from([(1.0, 2.0, 5.0), (0.5,)])), data.draw(st.integers(0, 40))
    found = chance.drawn(data.draw, table, count)
    assert found.shape == (count,)
    assert set(found.tolist()) <= set(table)
    assert sorted(chance.order(data.draw, count)) == list(range(count))
