"""The ladders of cases: named rungs of growing generality, each with a fixed core.

The strategies that draw further cases stand in `strategies.py`, which alone needs hypothesis: a
worker that only judges never imports it.
"""

from __future__ import annotations

from dataclasses import dataclass

from autograder.problems import core, wide
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
            "several loops: interior, backward and doubled edges in any order, also without a walk",
            0.24,
            core.SEVERAL_LOOPS + wide.WITHOUT_A_WALK,
            reason="only the list of edges is unusual here, so that a mistake about it is seen by itself.",
        ),
        Rung(
            "priors",
            "any number of priors on any poses, in any order, and parts that only their own prior holds",
            0.2,
            core.PRIORS + wide.PARTS_AND_PRIORS,
            reason="the priors and what they hold are unusual here, the numbers are not.",
        ),
        Rung(
            "variances",
            "variances that differ by powers of ten",
            0.15,
            core.VARIANCES + wide.FAR_VARIANCES,
            reason="mistakes about weights stand out by powers of ten, far above every tolerance.",
        ),
        Rung(
            "real_valued",
            "real numbers: states far out, near the minimum and almost there",
            0.2,
            core.REAL_VALUED + wide.WIDE_VALUES,
            reason="nice numbers cannot show rounding; these do, and single precision far from the origin.",
        ),
        Rung(
            "many_poses",
            "graphs of 10 to 100 poses",
            0.02,
            wide.MANY_POSES + core.MANY_POSES,
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
            core.UNEQUAL_WEIGHTS + wide.WIDE_WEIGHTS,
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
            "any real J and f, also ones that no graph has, large and small, with more columns than rows",
            0.25,
            core.DENSE + wide.WIDE_RESIDUALS + wide.FEWER_ROWS,
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
        Rung("distances", "distances to a beacon beside the line", 0.5, core.RANGES + wide.FAR_RANGES),
        Rung("derivatives", "how these distances change with x", 0.5, core.RANGES + wide.FAR_RANGES),
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
            "a loop inside any graph, with any priors and numbers",
            0.5,
            core.INNER_LOOPS + wide.WIDE_LOOPS,
            reason="the loop has to be found in a larger graph, where 0 to n - 1 is wrong.",
        ),
    ),
)
