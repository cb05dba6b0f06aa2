# expect: residual=passed jacobian=failed information_matrix=failed others=missing; 43: returns complex numbers.
# attack: lying; unlocked fails: only float64 bytes of the exact shape count.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    return np.full((graph.n_factors, graph.n_poses), 1 + 2j)


def information_matrix(graph):
    return [[1j] * graph.n_factors] * graph.n_factors
