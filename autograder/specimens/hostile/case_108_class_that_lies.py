# expect: residual=passed jacobian=failed information_matrix=error others=missing; 108: returns objects that claim to be arrays by __class__ and by the array interface.
# attack: lying; unlocked fails: only float64 bytes of the exact shape count.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


class Claims:
    __class__ = property(lambda self: np.ndarray)
    __array_interface__ = {"shape": (4, 4), "typestr": "<f8", "data": (4096, True), "version": 3}


def jacobian(x, graph):
    return Claims()


def information_matrix(graph):
    return [Claims()]
