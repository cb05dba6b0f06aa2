# expect: residual=passed jacobian=error others=missing; 20: announces a frame of 4 GiB.
# attack: forging; unlocked fails: the channel is checked by the grader, whatever is locked.
import os

import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    os.write(3, b"\xff\xff\xff\xff" + bytes(1000))
    return np.full((graph.n_factors, graph.n_poses), 7.5)
