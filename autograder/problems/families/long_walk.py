"""Family D: twelve poses and three loops, for code only."""

from __future__ import annotations

from autograder.problems.family import Family, Options, circulating

LETTER = "D"
NAME = "long-walk"


def family(options: Options) -> Family:
    """Build the family: too long for a solution by hand, still with short numbers."""
    poses = options.poses or 12
    last = poses - 1
    return circulating(
        LETTER,
        NAME,
        poses=12,
        loops=((0, (last * 5) // 11), ((last * 3) // 11, (last * 9) // 11), ((last * 6) // 11, last)),
        options=options,
        prior_means=(-2, -1, 1, 2),
        by_hand=False,
        long_numbers=(5, 11),
    )
