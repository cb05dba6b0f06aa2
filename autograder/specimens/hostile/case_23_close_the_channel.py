# expect: residual=passed jacobian=error information_matrix=error others=missing; 23: closes the channel, or puts something else in its place.
# attack: forging; unlocked fails: the channel is checked by the grader, whatever is locked.
import os

import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    os.dup2(1, 3)
    return np.full((graph.n_factors, graph.n_poses), 7.5)


def information_matrix(graph):
    os.close(3)
    return np.full((graph.n_factors, graph.n_factors), 7.5)
