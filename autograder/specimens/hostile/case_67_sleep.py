# expect: residual=passed jacobian=timeout others=missing; 67: sleeps for thirty years.
# attack: exhaustion; unlocked fails: an end without a value is no value.
import time

import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    time.sleep(1e9)
