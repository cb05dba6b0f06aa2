"""The paragraph "What is graded" of the handout, clause by clause, against the cases that are drawn."""

import numpy as np
import pytest

from autograder.problems.draw import draw_ladder
from autograder.problems.graphs import loop_edges
from autograder.problems.ladders import GRAPHS, LOOPS, MATRICES
from autograder.problems.problem import worked_problem
from autograder.render.handout import render_assignment

TEXT = render_assignment(worked_problem())["README.md"].partition("## What is graded")[2].partition("\n|")[0]


@pytest.fixture(scope="module")
def drawn():
    """Every case with a graph, as drawn for a class: (x, graph)."""
    return [case for found in draw_ladder(GRAPHS, 0, 200).values() for case in found]


def parts(graph):
    """Number of connected parts, by joining the ends of every edge."""
    part = np.arange(graph.n_poses)
    for i, j in graph.edges:
        part[part == part[i]] = part[j]
    return len(set(part.tolist()))


def test_graphs_are_connected_and_of_the_sizes_that_are_told(drawn):
    """The smallest and the largest are named, none is in two parts, and each has a prior."""
    sizes = [graph.n_poses for _x, graph in drawn]
    assert f"connected graphs of {min(sizes)} to {max(sizes)} poses" in TEXT
    assert {parts(graph) for _x, graph in drawn} == {1}
    assert "There is always a prior" in TEXT
    assert min(len(graph.priors) for _x, graph in drawn) == 1


def test_edges_come_in_every_way_that_is_told(drawn):
    """Any order, backwards, several between the same poses; none, one or several loops, not only from pose 0."""
    assert "edges in any order, forwards and backwards, several between the same poses" in TEXT
    edges = [graph.edges.tolist() for _x, graph in drawn]
    assert any(pairs != sorted(pairs) for pairs in edges)
    assert any(i > j for pairs in edges for i, j in pairs)
    assert any(len({frozenset(pair) for pair in pairs}) < len(pairs) for pairs in edges)
    assert "none, one or several loops that begin at any pose" in TEXT
    loops = {len(graph.edges) - graph.n_poses + 1 for _x, graph in drawn}
    assert {0, 1, 2} <= loops
    begun = {int(graph.edges[loop_edges(graph)].min()) for _states, graph in cases(LOOPS)}
    assert {0, 1} <= begun


def test_priors_stand_where_it_is_told(drawn):
    """One or two, on any poses, also both on one, with means that are not 0."""
    assert "one or two priors on any poses, also both on one, with any means" in TEXT
    priors = [graph.priors.tolist() for _x, graph in drawn]
    assert {len(poses) for poses in priors} == {1, 2}
    assert any(0 not in poses for poses in priors)
    assert any(len(set(poses)) < len(poses) for poses in priors)
    assert any(np.any(graph.prior_means) for _x, graph in drawn)


def test_numbers_are_as_it_is_told(drawn):
    """Many digits, variances that differ by powers of ten, and states far from dead reckoning."""
    assert "measurements that are real numbers with many digits; variances that differ by powers of ten" in TEXT
    assert any(np.any(graph.measurements != graph.measurements.round(6)) for _x, graph in drawn)
    assert any(graph.edge_variances.max() > 1000 * graph.edge_variances.min() for _x, graph in drawn)
    assert "states far from dead reckoning" in TEXT
    far = [np.abs(x - graph.dead_reckoning()).max() > 1.0 for x, graph in drawn]
    assert np.mean(far) > 0.5


def test_matrices_are_as_it_is_told():
    """Some J belongs to no graph; omega is diagonal and positive in all cases."""
    assert "matrices that belong to no graph; `omega` is always diagonal, with positive entries" in TEXT
    matrices = cases(MATRICES)
    assert any(np.any((J != 0).sum(axis=1) > 2) for J, _omega, _f in matrices)
    assert all(np.array_equal(omega, np.diag(np.diag(omega))) for _J, omega, _f in matrices)
    assert all((np.diag(omega) > 0).all() for _J, omega, _f in matrices)


def test_the_second_step_is_taken_as_it_is_told():
    """From two starts that differ."""
    assert "`second_step` takes your step from several starts, and again with a measurement changed" in TEXT
    assert all(np.abs(one - two).max() > 0 for (one, two), _graph in cases(LOOPS))


def cases(ladder):
    """All cases of a ladder."""
    return [case for found in draw_ladder(ladder, 0, 200).values() for case in found]
