"""The worked example of the handout: five poses, one loop closure, equal variances."""

from __future__ import annotations

from assignment.posegraph import PoseGraph

__all__ = ["worked_example"]


def worked_example() -> PoseGraph:
    """Return the worked example of the handout.

    Examples
    --------
    >>> worked_example().dead_reckoning()
    array([0. , 1.1, 2.1, 3.2, 0.5])
    """
    return PoseGraph(
        n_poses=5,
        edges=[(0, 1), (1, 2), (2, 3), (3, 4), (0, 4)],
        measurements=[1.1, 1.0, 1.1, -2.7, 0.0],
        edge_variances=[0.01, 0.01, 0.01, 0.01, 0.01],
        priors=[0],
        prior_means=[0.0],
        prior_variances=[0.001],
    )
