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
    reason : str
        Why the rung is kept although every known mistake that it shows is shown by another one too.
    """

    name: str
    line: str
    share: float
    core: tuple[Case, ...]
    reason: str = ""


@dataclass(frozen=True)
class Ladder:
    """Named rungs, from simple to rich."""

    name: str
    rungs: tuple[Rung, ...]


GRAPHS = Ladder(
    "graphs",
    (
        Rung(
            "worked_example",
            "the worked example of the handout, at several states",
            0.0,
            core.WORKED_EXAMPLE,
            reason="a student can follow it by hand, and whoever has done no more than the handout earns something.",
        ),
        Rung(
            "single_loops",
            "one loop, few poses, unequal variances",
            0.2,
            core.SINGLE_LOOPS,
            reason="the smallest graphs that show mistakes about loops and weights: a student is shown these.",
        ),
        Rung(
            "several_loops",
            "several loops: interior, backward and doubled edges in any order",
            0.25,
            core.SEVERAL_LOOPS,
            reason="only the list of edges is unusual here, so that a mistake about it is seen by itself.",
        ),
        Rung(
            "priors",
            "priors on other poses, two priors, means that are not 0",
            0.2,
            core.PRIORS,
            reason="only the priors are unusual here, so that a mistake about them is seen by itself.",
        ),
        Rung(
            "variances",
            "variances that differ by powers of ten",
            0.15,
            core.VARIANCES,
            reason="mistakes about weights stand out by powers of ten, far above every tolerance.",
        ),
        Rung(
            "real_valued",
            "real numbers, far from dead reckoning",
            0.2,
            core.REAL_VALUED,
            reason="nice numbers cannot show rounding; these do, and single precision far from the origin.",
        ),
        Rung(
            "hundred_poses",
            "one graph of 100 poses",
            0.0,
            core.HUNDRED_POSES,
            reason="code that is made for few poses, or that needs seconds for many, is wrong here.",
        ),
    ),
)

MATRICES = Ladder(
    "matrices",
    (
        Rung(
            "whole_numbers",
            "small matrices of whole numbers",
            0.3,
            core.WHOLE_NUMBERS,
            reason="a student can follow it by hand.",
        ),
        Rung(
            "unequal_weights",
            "weights that differ by powers of ten",
            0.2,
            core.UNEQUAL_WEIGHTS,
            reason="mistakes about Omega stand out by powers of ten, far above every tolerance.",
        ),
        Rung(
            "graph_shaped",
            "J with two entries in a row, as pose graphs have",
            0.25,
            core.GRAPH_SHAPED,
            reason="matrices as the step hands them over: whoever is right on these builds on H and b that are right.",
        ),
        Rung(
            "dense",
            "any real J and f, also ones that no graph has",
            0.25,
            core.DENSE,
            reason="code that relies on the pattern of J in pose graphs is wrong here.",
        ),
        Rung(
            "large",
            "one system of 80 rows",
            0.0,
            core.LARGE,
            reason="code that is made for few rows, or that needs seconds for many, is wrong here.",
        ),
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
        Rung(
            "worked_example",
            "the worked example of the handout",
            0.0,
            core.WORKED_LOOP,
            reason="a student can follow it by hand.",
        ),
        Rung(
            "single_loops",
            "one loop through all poses",
            0.5,
            core.FULL_LOOPS,
            reason="every pose lies on the loop, so no measurement can be left out unseen.",
        ),
        Rung(
            "loops_in_graphs",
            "a loop inside a longer walk, edges in any direction and order",
            0.5,
            core.INNER_LOOPS,
            reason="the loop has to be found in a longer walk, where 0 to n - 1 is wrong.",
        ),
    ),
)
