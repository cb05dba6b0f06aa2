# expect: residual=passed jacobian=timeout information_matrix=timeout others=missing; 66: gets stuck inside one operation: a huge power, and a regular expression that backtracks.
# attack: exhaustion; unlocked fails: an end without a value is no value.
import re

import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    return 10 ** 10**9


def information_matrix(graph):
    return re.match(r"(a*)*b", "a" * 40)
