# expect: residual=passed information_matrix=failed gauss_newton_step=failed second_step=failed others=missing; 53: answers rightly every second time.
# attack: lying; unlocked fails: only float64 bytes of the exact shape count.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


COUNT = [0]


def information_matrix(graph):
    COUNT[0] += 1
    right = np.diag(1 / np.concatenate([graph.edge_variances, graph.prior_variances]))
    return right + 1 if COUNT[0] % 2 else right


def gauss_newton_step(x, graph):
    COUNT[0] += 1
    return -x if COUNT[0] % 2 else np.zeros(graph.n_poses)
