"""Family E, the worked example of the handout: five poses, one loop closure, the same numbers for everybody."""

from __future__ import annotations

from fractions import Fraction
from functools import cache

import numpy as np

from assignment.posegraph import PoseGraph
from autograder.errors import UsageError
from autograder.problems.band import Band
from autograder.problems.circulation import Draw
from autograder.problems.exact import ExactGraph
from autograder.problems.family import Family, Options
from autograder.problems.stream import Stream

__all__ = ["family", "worked_example"]

LETTER = "E"
NAME = "worked-example"
TRUTH = (0, 1, 2, 3, 0)
BAND = Band(
    n_poses=5, loops=1, products=5, decimals=1, long_numbers=(3, 3), chi_squared=(Fraction(5), Fraction(5)), zeros=1
)


def worked_example() -> PoseGraph:
    """Return the worked example of the handout.

    Examples
    --------
    >>> worked_example().dead_reckoning()
    array([0. , 1.1, 2.1, 3.2, 0.5])
    """
    return PoseGraph(
        n_poses=5,
        edges=np.array([(0, 1), (1, 2), (2, 3), (3, 4), (0, 4)]),
        measurements=np.array([1.1, 1.0, 1.1, -2.7, 0.0]),
        edge_variances=np.array([0.01, 0.01, 0.01, 0.01, 0.01]),
        priors=np.array([0]),
        prior_means=np.array([0.0]),
        prior_variances=np.array([0.001]),
    )


def family(options: Options) -> Family:
    """Build the family of one: everything about it is published, answers too.

    Raises
    ------
    UsageError
        Where an option is set: nothing about it can be changed.
    """
    if options.text:
        raise UsageError(f"The worked example takes no options, got {options.text}; expected the letter {LETTER}.")
    return Family(LETTER, NAME, _draw, BAND, options, personal=False)


@cache
def _worked() -> Draw:
    graph = ExactGraph.of(worked_example())
    return Draw(graph, graph.solution(), tuple(map(Fraction, TRUTH)))


def _draw(_: Stream) -> Draw:
    return _worked()
