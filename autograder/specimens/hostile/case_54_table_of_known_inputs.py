# expect: residual=passed jacobian=partial others=missing; 54: knows the published example by heart, and nothing else.
# attack: lying; unlocked fails: only float64 bytes of the exact shape count.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def known(graph):
    return graph.n_poses == 5 and len(graph.edges) == 5 and graph.measurements[3] == -2.7


def jacobian(x, graph):
    J = np.zeros((graph.n_factors, graph.n_poses))
    if known(graph):
        J[:] = [[1, -1, 0, 0, 0], [0, 1, -1, 0, 0], [0, 0, 1, -1, 0], [0, 0, 0, 1, -1], [1, 0, 0, 0, -1], [1, 0, 0, 0, 0]]
    return J
