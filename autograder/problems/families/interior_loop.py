"""Family B: six poses and a loop over the inner ones, so that the ends move along with it or stay."""

from __future__ import annotations

from autograder.problems.family import Family, Options, circulating

LETTER = "B"
NAME = "interior-loop"


def family(options: Options) -> Family:
    """Build the family: the prior's mean is not 0, and the loop does not begin at the prior."""
    last = (options.poses or 6) - 1
    return circulating(
        LETTER,
        NAME,
        poses=6,
        loops=((1, last - 1),),
        options=options,
        prior_means=(1, 2, 3),
        both_signs=False,
        long_numbers=(1, 3),
    )
