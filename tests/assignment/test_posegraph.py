"""PoseGraph and Ranging: validated, immutable, equal by value, readable."""

import copy
import dataclasses
import pickle

import numpy as np
import pytest

from assignment.posegraph import PoseGraph, Ranging

FIELDS = {
    "n_poses": 3,
    "edges": [(0, 1), (2, 1)],
    "measurements": [1.0, -2.0],
    "edge_variances": [0.01, 0.04],
    "priors": [1],
    "prior_means": [3.0],
    "prior_variances": [0.001],
}


def build(**changes):
    """Build a small valid graph with some fields changed."""
    return PoseGraph(**{**FIELDS, **changes})


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"n_poses": 1}, "n_poses must be at least 2, got 1"),
        ({"n_poses": 2.5}, "n_poses must be an integer, got 2.5"),
        ({"n_poses": True}, "n_poses must be an integer, got True"),
        ({"edges": [(0, 1), (2, 3)]}, "edges must name poses 0 to 2, got 3"),
        ({"edges": [(0, 1), (-1, 1)]}, "edges must name poses 0 to 2, got -1"),
        ({"edges": [(0, 1), (2, 2)]}, r"edges must join two different poses, got \(2, 2\) in row 1"),
        ({"edges": [(0.5, 1), (2, 1)]}, "edges must hold pairs of integers"),
        ({"edges": [0, 1]}, r"edges must hold pairs of integers, shape \(k, 2\), got shape \(2,\)"),
        ({"edges": [(0, 1), (2,)]}, "edges must hold pairs of integers"),
        ({"measurements": [1.0]}, r"measurements must hold 2 real numbers, got shape \(1,\)"),
        ({"measurements": [1.0, np.nan]}, "measurements must be finite"),
        ({"measurements": ["a", "b"]}, "measurements must hold 2 real numbers"),
        ({"measurements": [1.0, 2j]}, "measurements must hold 2 real numbers"),
        ({"edge_variances": [0.01, 0.0]}, "edge_variances must be > 0, got 0.0"),
        ({"edge_variances": [0.01, -1]}, "edge_variances must be > 0, got -1.0"),
        ({"priors": [3]}, "priors must name poses 0 to 2, got 3"),
        ({"priors": [True]}, "priors must hold integers"),
        ({"prior_means": [np.inf]}, "prior_means must be finite"),
        ({"prior_means": []}, r"prior_means must hold 1 real number, got shape \(0,\)"),
        ({"prior_variances": [0]}, "prior_variances must be > 0, got 0.0"),
    ],
)
def test_a_broken_rule_is_named(changes, words):
    """The message names the field, the rule and the value."""
    with pytest.raises(ValueError, match=words):
        build(**changes)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"beacon": [1.0]}, "beacon must hold 2 real numbers"),
        ({"beacon": [1.0, 0.0]}, "beacon must stand off the line"),
        ({"poses": [-1]}, "poses must be at least 0, got -1"),
        ({"ranges": [-0.5]}, "ranges must be at least 0, got -0.5"),
        ({"variances": [0.0]}, "variances must be > 0, got 0.0"),
    ],
)
def test_ranging_rules(changes, words):
    """A Ranging names field, rule and value as well."""
    fields = {"beacon": [2.0, 1.0], "poses": [3], "ranges": [1.4], "variances": [0.01]}
    with pytest.raises(ValueError, match=words):
        Ranging(**{**fields, **changes})


def test_arrays_cannot_be_changed():
    """No field can be set, no array written, not even after setflags."""
    graph = build()
    with pytest.raises(dataclasses.FrozenInstanceError):
        graph.n_poses = 4
    for name in FIELDS:
        value = getattr(graph, name)
        if isinstance(value, np.ndarray):
            with pytest.raises(ValueError, match="read-only"):
                value[0] = 7
            with pytest.raises(ValueError, match="WRITEABLE"):
                value.setflags(write=True)


def test_the_callers_arrays_are_copied():
    """Changing what was passed in changes nothing."""
    measurements = np.array([1.0, -2.0])
    graph = build(measurements=measurements)
    measurements[0] = 99.0
    assert graph == build()


def test_equal_by_value_and_hashable():
    """Two graphs of equal fields are equal and hash alike; any other field makes them differ."""
    assert build() == build()
    assert hash(build()) == hash(build())
    assert build(measurements=[1.0, -0.0]) == build(measurements=[1.0, 0.0])
    assert hash(build(measurements=[1.0, -0.0])) == hash(build(measurements=[1.0, 0.0]))
    others = [build(n_poses=4), build(measurements=[1.0, 2.0]), build(priors=[0]), build(edge_variances=[1, 1])]
    assert len({build(), *others}) == 5
    assert build() != "a graph"


def test_copies_and_pickles_are_equal():
    """copy, deepcopy and pickle keep value and immutability."""
    for made in (copy.copy(build()), copy.deepcopy(build()), pickle.loads(pickle.dumps(build()))):
        assert made == build()
        assert not made.measurements.flags.writeable


def test_rows_are_counted():
    """M is edges plus priors; the repr has a line for each."""
    graph = build()
    assert graph.n_factors == 3
    assert len(repr(graph).splitlines()) == 1 + 3


def test_an_empty_graph_of_poses_is_allowed():
    """Without factors there is nothing to add up: m is 0, and dead reckoning says what is missing."""
    graph = PoseGraph(2, [], [], [], [], [], [])
    assert graph.n_factors == 0
    with pytest.raises(ValueError, match="got none for the part of pose 0"):
        graph.dead_reckoning()


class TestDeadReckoning:
    """The start state."""

    def test_loop_closures_after_the_walk_change_nothing(self):
        """Each pose is placed once, by the first edge that reaches it."""
        graph = PoseGraph(3, [(0, 1), (1, 2), (0, 2)], [1, 1, 5], [1] * 3, [0], [2.0], [1])
        np.testing.assert_array_equal(graph.dead_reckoning(), [2, 3, 4])

    def test_backward_edges_count_with_the_opposite_sign(self):
        """An edge from j to i places j at x_i - u."""
        graph = PoseGraph(3, [(1, 0), (2, 1)], [-1.0, -2.0], [1] * 2, [0], [0.0], [1])
        np.testing.assert_array_equal(graph.dead_reckoning(), [0, 1, 3])

    def test_edges_in_any_order(self):
        """Sweeps go on until every pose is reached."""
        graph = PoseGraph(4, [(2, 3), (1, 2), (0, 1)], [1, 1, 1], [1] * 3, [0], [0.0], [1])
        np.testing.assert_array_equal(graph.dead_reckoning(), [0, 1, 2, 3])

    def test_every_part_starts_from_its_first_prior(self):
        """Two parts, two origins; a second prior in a part is not an origin."""
        graph = PoseGraph(4, [(0, 1), (2, 3)], [1, 1], [1] * 2, [3, 0, 1], [5.0, 1.0, 9.0], [1] * 3)
        np.testing.assert_array_equal(graph.dead_reckoning(), [1, 2, 4, 5])

    def test_a_part_without_a_prior_is_named(self):
        """The message names the first pose that has no origin."""
        with pytest.raises(ValueError, match="part of pose 2"):
            PoseGraph(4, [(0, 1), (2, 3)], [1, 1], [1] * 2, [0], [0.0], [1]).dead_reckoning()
