"""Graphs and states on which slips show: the twelve of the catalogue, and random ones with a fixed seed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from assignment.posegraph import PoseGraph

Case = tuple[np.ndarray, PoseGraph]

WALK = [(0, 1, 1.1), (1, 2, 1.0), (2, 3, 1.1), (3, 4, -2.7)]


def built(
    n_poses: int,
    edges: list[tuple[int, int, float]],
    variances: list[float] | None = None,
    priors: tuple[tuple[int, float, float], ...] = ((0, 0.0, 0.001),),
) -> PoseGraph:
    """Build a graph from rows (i, j, measurement) and (pose, mean, variance); a variance is 0.01 if not given."""
    return PoseGraph(
        n_poses,
        np.array([row[:2] for row in edges]),
        np.array([row[2] for row in edges]),
        np.array(variances or [0.01] * len(edges)),
        np.array([row[0] for row in priors]),
        np.array([row[1] for row in priors]),
        np.array([row[2] for row in priors]),
    )


GRAPHS = {
    "E: worked example": built(5, [*WALK, (0, 4, 0.0)]),
    "V: unequal variances": built(5, [*WALK, (0, 4, 0.0)], [0.04, 0.01, 0.05, 0.02, 0.01]),
    "Z: loop measured at 0.3": built(5, [*WALK, (0, 4, 0.3)]),
    "I: interior loop": built(6, [(0, 1, 1.1), (1, 2, 1.0), (2, 3, 1.1), (3, 4, -2.7), (4, 5, 1.2), (1, 4, -0.9)]),
    "P: prior mean 2": built(5, [*WALK, (0, 4, 0.0)], priors=((0, 2.0, 0.001),)),
    "S: prior off the start": built(5, [*WALK, (0, 4, 0.0)], priors=((0, 0.3, 0.001),)),
    "L: two loops": built(5, [*WALK, (0, 4, 0.0), (1, 3, 2.0)]),
    "N: three poses": built(3, [(0, 1, 1.1), (1, 2, 1.0), (0, 2, 1.9)]),
    "B: backward edge": built(5, [*WALK, (4, 0, 0.2)]),
    "O: loop listed first": built(5, [(0, 4, 0.2), *WALK]),
    "Q: second prior": built(5, [*WALK, (0, 4, 0.0)], priors=((0, 0.0, 0.001), (3, 2.5, 0.02))),
    "X: all at once": built(
        6,
        [(4, 1, 0.8), (0, 1, 1.1), (2, 1, -1.3), (2, 3, 1.1), (5, 3, 2.1), (3, 4, -2.7), (0, 2, 1.7), (4, 5, 1.2)],
        [0.02, 0.3, 0.01, 0.05, 0.004, 0.1, 0.02, 0.9],
        ((3, 2.5, 0.02), (0, 0.7, 0.005)),
    ),
}


def random_graph(rng: np.random.Generator, n_poses: int) -> PoseGraph:
    """Draw a connected graph: a tree, some edges more, directions and order at random, one to three priors."""
    pairs = [(int(rng.integers(pose)), pose) for pose in range(1, n_poses)]
    while len(pairs) < n_poses + int(rng.integers(1, 3)):
        i, j = rng.choice(n_poses, 2, replace=False)
        pairs.append((int(i), int(j)))
    rng.shuffle(pairs)
    k, p = len(pairs), int(rng.integers(1, 4))
    return PoseGraph(
        n_poses,
        np.array([pair[:: rng.choice([-1, 1])] for pair in pairs]),
        rng.normal(scale=2.0, size=k),
        10.0 ** rng.uniform(-2.5, 0.7, k),
        rng.integers(0, n_poses, p),
        rng.normal(scale=3.0, size=p),
        10.0 ** rng.uniform(-2.5, 0.7, p),
    )


def unusual(rng: np.random.Generator, n_poses: int) -> list[Case]:
    """Draw what is no walk near the origin: parts without edges between them, far, near, certain and stiff graphs."""
    plain = random_graph(rng, n_poses)
    kept, everywhere = plain.edges[: n_poses // 2], rng.permutation(n_poses)
    parts = PoseGraph(
        n_poses,
        kept,
        plain.measurements[: len(kept)],
        plain.edge_variances[: len(kept)],
        everywhere,
        rng.normal(scale=3.0, size=n_poses),
        10.0 ** rng.uniform(-2.0, 0.5, n_poses),
    )
    far = replace(plain, measurements=60.0 * plain.measurements, prior_means=20.0 * plain.prior_means)
    certain = replace(plain, edge_variances=plain.edge_variances * 1e-3, prior_variances=plain.prior_variances * 1e-3)
    stiff = replace(plain, edge_variances=plain.edge_variances * 0.1, prior_variances=plain.prior_variances * 100)
    x = rng.normal(scale=4.0, size=n_poses)
    truth = rng.normal(scale=4.0, size=n_poses)
    i, j = plain.edges.T
    agreed = replace(plain, measurements=truth[j] - truth[i], prior_means=truth[plain.priors])
    shift = rng.uniform(2e-4, 8e-4, n_poses)
    return [
        (x, parts),
        (20.0 * x, far),
        (x, certain),
        (x, stiff),
        (truth + shift, agreed),
        (truth + 40 * shift, agreed),
    ]


def cases(*sizes: int, each: int = 12, seed: int = 7) -> list[Case]:
    """Draw `each` random graphs of every size, each with a state of its own, and unusual ones."""
    rng = np.random.default_rng(seed)
    graphs = [random_graph(rng, n_poses) for n_poses in sizes for _ in range(each)]
    usual = [(rng.normal(scale=4.0, size=graph.n_poses), graph) for graph in graphs]
    return usual + [case for n_poses in sizes for case in unusual(rng, n_poses)]


def pool(*, beyond: bool = True) -> list[Case]:
    """Return the twelve graphs at dead reckoning and at a random state, 36 random ones, and unusual ones if asked."""
    rng = np.random.default_rng(3)
    starts = [(graph.dead_reckoning(), graph) for graph in GRAPHS.values()]
    elsewhere = [(rng.normal(scale=4.0, size=graph.n_poses), graph) for graph in GRAPHS.values()]
    drawn = cases(2, 3, 4, 5, 6, 9, each=6)
    return [*starts, *elsewhere, *(drawn if beyond else drawn[:36])]


def systems(*sizes: int, each: int = 8, seed: int = 5) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Draw any real J and f and a positive diagonal Omega, `each` for every number of columns, and large ones."""
    rng = np.random.default_rng(seed)
    found = []
    for n in sizes:
        for number in range(each):
            m = n + int(rng.integers(1, 4))
            weights = np.diag(10.0 ** rng.uniform(-1.0, 3.0, m))
            found.append((rng.normal(scale=2.0, size=(m, n)), weights, rng.normal(scale=3.0, size=m)))
            if number % 4 == 0:
                weights = np.diag(10.0 ** rng.uniform(-3.0, 5.0, m))
                found.append((rng.normal(scale=2.0, size=(m, n)), weights, rng.normal(scale=200.0, size=m)))
    return found
