# expect: residual=passed jacobian=memory information_matrix=memory others=missing; 49: returns arrays of 10^8 elements.
# attack: lying; unlocked left out: takes memory until the machine has none.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    return np.zeros(10**8)


def information_matrix(graph):
    return np.zeros((10**4, 10**4))
