"""Family C: six poses and two loops that share a part of the way, so that each pulls at the other."""

from __future__ import annotations

from autograder.problems.family import Family, Options, circulating

LETTER = "C"
NAME = "overlapping-loops"


def family(options: Options) -> Family:
    """Build the family: two mismatches, two forces, a 2 x 2 system."""
    poses = options.poses or 6
    return circulating(
        LETTER,
        NAME,
        poses=6,
        loops=((0, poses - 3), (2, poses - 1)),
        options=options,
        prior_means=(1, 2, 3),
        long_numbers=(2, 5),
    )
