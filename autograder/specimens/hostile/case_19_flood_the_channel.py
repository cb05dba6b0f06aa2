# expect: residual=passed jacobian=error others=missing; 19: writes garbage to the channel without end.
# attack: forging; unlocked fails: the channel is checked by the grader, whatever is locked.
import os

import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    while True:
        os.write(3, bytes(range(255, 0, -1)) * 256)
