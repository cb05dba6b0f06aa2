# expect: residual=passed jacobian=error information_matrix=error others=missing; 55: calls sys.exit(0) while it is loaded and in a function.
# attack: leaving; unlocked fails: an end without a value is no value.
import sys

import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    sys.exit(0)


def information_matrix(graph):
    raise SystemExit


sys.exit(0)
