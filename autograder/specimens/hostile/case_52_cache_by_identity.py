# expect: residual=passed jacobian=failed gauss_newton_step=failed second_step=failed others=missing; 52: keeps answers by the identity of its arguments.
# attack: lying; unlocked fails: only float64 bytes of the exact shape count.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


CACHE = {}


def jacobian(x, graph):
    return CACHE.setdefault((id(x), id(graph)), np.full((graph.n_factors, graph.n_poses), 7.5))


def gauss_newton_step(x, graph):
    return CACHE.setdefault(id(x), np.full(graph.n_poses, 7.5))
