# expect: residual=passed jacobian=timeout information_matrix=timeout others=missing; 65: computes without end, in Python and in BLAS.
# attack: exhaustion; unlocked fails: an end without a value is no value.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    while True:
        pass


def information_matrix(graph):
    A = np.ones((900, 900))
    while True:
        A = A @ A * 1e-3
