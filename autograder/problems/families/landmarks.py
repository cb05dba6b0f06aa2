"""Family L: four poses that see two landmarks, each of them twice."""

from __future__ import annotations

from dataclasses import replace

from autograder.errors import UsageError
from autograder.problems.family import Family, Options, circulating

LETTER = "L"
NAME = "landmarks"


def family(options: Options) -> Family:
    """Build the family: a landmark is one more unknown, and seeing it again closes a loop.

    The first landmark is seen from the first pose and from the last but one, the second landmark
    from the second pose and from the last.

    Raises
    ------
    UsageError
        Where loops are set: here they follow from what is seen.
    """
    if options.loops is not None:
        raise UsageError("Family L takes no option loops; expected poses, prior_mean or decimals.")
    poses = options.poses or 4
    first, second = poses, poses + 1
    built = circulating(
        LETTER,
        NAME,
        poses=poses + 2,
        tree=(*((k, k + 1) for k in range(poses - 1)), (0, first), (1, second)),
        loops=((poses - 2, first), (poses - 1, second)),
        options=replace(options, poses=None),
        prior_means=(1, 2, 3),
        landmarks=(first, second),
        long_numbers=(2, 5) if poses == 4 else (0, poses + 3),
    )
    return replace(built, options=options)
