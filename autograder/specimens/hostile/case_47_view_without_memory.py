# expect: residual=passed jacobian=failed information_matrix=failed normal_equations=failed others=missing; 47: returns a view of 10^12 elements that takes no memory.
# attack: lying; unlocked fails: only float64 bytes of the exact shape count.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    return np.broadcast_to(0.0, (10**6, 10**6))


def information_matrix(graph):
    return np.lib.stride_tricks.as_strided(np.zeros(1), (10**9, 10**9), (0, 0))


def normal_equations(J, omega, f):
    return np.empty((10**18, 0)), np.empty((0,))
