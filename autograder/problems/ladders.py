"""The ladders of cases: named rungs of growing generality, each with a fixed core.

The strategies that draw further cases stand in `strategies.py`, which alone needs hypothesis: a
worker that only judges never imports it.
"""

from __future__ import annotations

from dataclasses import dataclass

from autograder.problems import core
from autograder.problems.cases import Case


@dataclass(frozen=True)
class Rung:
    """One step of a ladder.

    Parameters
    ----------
    name : str
        Name of the check that is made of its cases.
    line : str
        What the check asks, as the student reads it.
    share : float
        Share of the drawn cases of the ladder that fall on this rung; 0 where the core is all.
    core : tuple of cases
        Present under every seed and however few cases are drawn.
    """

    name: str
    line: str
    share: float
    core: tuple[Case, ...]


@dataclass(frozen=True)
class Ladder:
    """Named rungs, from simple to rich."""

    name: str
    rungs: tuple[Rung, ...]


GRAPHS = Ladder(
    "graphs",
    (
        Rung("worked_example", "the worked example of the handout, at several states", 0.0, core.WORKED_EXAMPLE),
        Rung("single_loops", "one loop, few poses, unequal variances", 0.2, core.SINGLE_LOOPS),
        Rung(
            "several_loops",
            "several loops: interior, backward and doubled edges in any order",
            0.25,
            core.SEVERAL_LOOPS,
        ),
        Rung("priors", "priors on other poses, two priors, means that are not 0", 0.2, core.PRIORS),
        Rung("variances", "variances that differ by powers of ten", 0.15, core.VARIANCES),
        Rung("real_valued", "real numbers, far from dead reckoning", 0.2, core.REAL_VALUED),
        Rung("hundred_poses", "one graph of 100 poses", 0.0, core.HUNDRED_POSES),
    ),
)

MATRICES = Ladder(
    "matrices",
    (
        Rung("whole_numbers", "small matrices of whole numbers", 0.3, core.WHOLE_NUMBERS),
        Rung("unequal_weights", "weights that differ by powers of ten", 0.2, core.UNEQUAL_WEIGHTS),
        Rung("graph_shaped", "J with two entries in a row, as pose graphs have", 0.25, core.GRAPH_SHAPED),
        Rung("dense", "any real J and f, also ones that no graph has", 0.25, core.DENSE),
        Rung("large", "one system of 80 rows", 0.0, core.LARGE),
    ),
)

RANGINGS = Ladder(
    "rangings",
    (
        Rung("distances", "distances to a beacon beside the line", 0.5, core.RANGES),
        Rung("derivatives", "how these distances change with x", 0.5, core.RANGES),
    ),
)

LOOPS = Ladder(
    "loops",
    (
        Rung("worked_example", "the worked example of the handout", 0.0, core.WORKED_LOOP),
        Rung("single_loops", "one loop through all poses", 0.5, core.FULL_LOOPS),
        Rung("loops_in_graphs", "a loop inside a longer walk, edges in any direction and order", 0.5, core.INNER_LOOPS),
    ),
)
