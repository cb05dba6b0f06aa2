"""The paragraph "What is graded" of the handout, clause by clause, against the cases that are drawn."""

import numpy as np
import pytest

from autograder.problems.draw import draw_ladder
from autograder.problems.graphs import loop_edges
from autograder.problems.ladders import GRAPHS, LOOPS, MATRICES
from autograder.problems.problem import worked_problem
from autograder.render.handout import render_assignment
from reference_solution.slam1d import gauss_newton_step

TEXT = render_assignment(worked_problem())["README.md"].partition("## What is graded")[2].partition("\n|")[0]


@pytest.fixture(scope="module")
def drawn():
    """Every case with a graph, as drawn for a class: (x, graph)."""
    return [case for found in draw_ladder(GRAPHS, 0, 200).values() for case in found]


def parts(graph):
    """For each pose the connected part that it belongs to, by joining the ends of every edge."""
    part = np.arange(graph.n_poses)
    for i, j in graph.edges:
        part[part == part[i]] = part[j]
    return part


def test_graphs_are_of_the_sizes_and_parts_that_are_told(drawn):
    """The smallest and the largest are named; some have a walk, some not; each part has a prior."""
    sizes = [graph.n_poses for _x, graph in drawn]
    assert f"graphs of {min(sizes)} to {max(sizes)} poses, with or without a walk 0, 1, 2, ... through all of" in TEXT
    walks = {all((i, i + 1) in edges or (i + 1, i) in edges for i in range(n - 1)) for n, edges in map(pairs, drawn)}
    assert walks == {True, False}
    assert "in one part or in several" in TEXT
    assert {1, 2, 3} <= {len(set(parts(graph))) for _x, graph in drawn}
    assert "Every part has a prior" in TEXT
    assert all(set(parts(graph)) == set(parts(graph)[graph.priors]) for _x, graph in drawn)


def pairs(case):
    """Return the number of poses, and the edges as pairs."""
    graph = case[1]
    return graph.n_poses, {(i, j) for i, j in graph.edges.tolist()}


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
    """One to many, in any order, on any poses, also several on one, with means that are not 0."""
    assert "any number of priors on any poses, in any order, also several on one, with any means" in TEXT
    priors = [graph.priors.tolist() for _x, graph in drawn]
    assert {1, 2, 3, 4, 5} <= {len(poses) for poses in priors}
    assert any(poses not in (sorted(poses), sorted(poses, reverse=True)) for poses in priors)
    assert any(0 not in poses for poses in priors)
    assert any(len(set(poses)) < len(poses) for poses in priors)
    assert any(np.any(graph.prior_means) for _x, graph in drawn)


def test_numbers_are_as_it_is_told(drawn):
    """Many digits and up to 200 m, variances over eight powers of ten, and states at, near and far from the minimum."""
    assert "measurements that are real numbers with many digits, up to 200 m" in TEXT
    assert any(np.any(graph.measurements != graph.measurements.round(6)) for _x, graph in drawn)
    assert 100 < max(np.abs(graph.measurements).max() for _x, graph in drawn) <= 200
    assert "variances from 0.00001 to 1000 m²" in TEXT
    variances = np.concatenate([np.append(graph.edge_variances, graph.prior_variances) for _x, graph in drawn])
    assert (variances.min(), variances.max()) == (1e-5, 1e3)
    assert "states at the minimum, near it, and far from it, up to 100 m from the origin" in TEXT
    steps = [np.abs(gauss_newton_step(x, graph)).max() for x, graph in drawn]
    assert min(steps) < 1e-12
    assert any(1e-12 < step < 1e-3 for step in steps)
    assert max(steps) > 100
    assert 75 < max(np.abs(x).max() for x, _graph in drawn) <= 100


def test_matrices_are_as_it_is_told():
    """Some J belongs to no graph, some has fewer rows; omega is diagonal in all cases, its weights as told."""
    assert "matrices that belong to no graph, with more rows than columns or with fewer, `f` up to 1000 m" in TEXT
    assert "`omega` is always diagonal, with entries from 0.001 to 100000 1/m²" in TEXT
    matrices = cases(MATRICES)
    assert {np.sign(J.shape[0] - J.shape[1]) for J, _omega, _f in matrices} >= {-1, 1}
    assert max(np.abs(f).max() for _J, _omega, f in matrices) == 1000
    assert any(np.any((J != 0).sum(axis=1) > 2) for J, _omega, _f in matrices)
    assert all(np.array_equal(omega, np.diag(np.diag(omega))) for _J, omega, _f in matrices)
    weights = np.concatenate([np.diag(omega) for _J, omega, _f in matrices])
    assert (weights.min(), weights.max()) == (1e-3, 1e5)


def test_the_second_step_is_taken_as_it_is_told():
    """From two starts that differ, with measurements changed, and where one state explains all of them."""
    assert "`second_step` takes your step from several starts, again with a measurement changed, and where" in TEXT
    assert all(np.abs(one - two).max() > 0 for (one, two), _graph in cases(LOOPS))


def cases(ladder):
    """All cases of a ladder."""
    return [case for found in draw_ladder(ladder, 0, 200).values() for case in found]
