# expect: residual=passed jacobian=failed others=missing; 08: walks the frames up to the first one and takes every function and array that looks like an answer.
# attack: secrets; unlocked fails: no answer is in the process, whatever is locked.
import sys

import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def answers():
    """Give everything that a frame above knows under the name of an answer."""
    frame = sys._getframe(1)
    while frame is not None:
        for names in (frame.f_locals, frame.f_globals):
            for name, value in list(names.items()):
                if value is not jacobian and (
                    name in ("jacobian", "expected", "reference", "answer", "solution", "right", "tolerance")
                    or getattr(value, "__module__", "") == "reference_solution.slam1d"
                ):
                    yield value
        frame = frame.f_back


def jacobian(x, graph):
    for value in answers():
        if callable(value) and getattr(value, "__name__", "") != "jacobian_of_mine":
            return value(x, graph)
        if isinstance(value, np.ndarray) and value.shape == (graph.n_factors, graph.n_poses):
            return value
    return np.full((graph.n_factors, graph.n_poses), 7.5)
