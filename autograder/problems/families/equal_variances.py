"""Family W: like the worked example, five poses, one loop over all of them, one variance for every edge."""

from __future__ import annotations

from autograder.problems.family import Family, Options, circulating

LETTER = "W"
NAME = "equal-variances"


def family(options: Options) -> Family:
    """Build the family: every edge gets the same share of the mismatch."""
    last = (options.poses or 5) - 1
    return circulating(
        LETTER,
        NAME,
        poses=5,
        loops=((0, last),),
        options=options,
        equal_variances=True,
        both_signs=False,
        long_numbers=(5, 5),
    )
