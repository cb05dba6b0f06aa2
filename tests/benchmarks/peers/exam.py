"""The hidden tests that every peer runs: four functions, 200 drawn graphs each, against the reference.

This file is copied beside a submission as `exam.py`, with `posegraph.py` and `reference.py`; it needs numpy only.
"""

import numpy as np
import reference
from posegraph import PoseGraph

SECRET = 20260


def graphs():
    """Draw 200 loops of three to seven poses, with a state each."""
    draw = np.random.default_rng(SECRET)
    for _ in range(200):
        n = int(draw.integers(3, 8))
        edges = [(i, i + 1) for i in range(n - 1)] + [(0, n - 1)]
        yield (
            draw.normal(0, 3, n),
            PoseGraph(n, edges, draw.normal(1, 1, n), draw.uniform(0.01, 1, n), [0], [0.5], [0.02]),
        )


def check(name, function):
    """Compare one function with the reference on all graphs."""
    for x, graph in graphs():
        arguments = (graph,) if name == "information_matrix" else (x, graph)
        got = function(*arguments)
        wanted = getattr(reference, name)(*arguments)
        assert np.allclose(got, wanted, atol=1e-6), f"{name} is wrong"
