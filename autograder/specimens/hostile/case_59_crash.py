# expect: residual=passed jacobian=error information_matrix=error others=missing; 59: crashes the interpreter.
# attack: leaving; unlocked fails: an end without a value is no value.
import sys

import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    sys.modules["ctypes"].string_at(0)


def information_matrix(graph):
    sys.modules["ctypes"].CDLL(None).abort()


sys.modules["ctypes"].string_at(8)
