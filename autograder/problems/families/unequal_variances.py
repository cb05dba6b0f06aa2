"""Family A: five poses, one loop over all of them, a variance of its own for every edge."""

from __future__ import annotations

from autograder.problems.family import Family, Options, circulating

LETTER = "A"
NAME = "unequal-variances"


def family(options: Options) -> Family:
    """Build the family: the less certain an edge, the more it gives way."""
    last = (options.poses or 5) - 1
    return circulating(
        LETTER,
        NAME,
        poses=5,
        loops=((0, last),),
        options=options,
        both_signs=False,
        long_numbers=(2, 4),
    )
