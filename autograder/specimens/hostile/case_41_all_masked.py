# expect: residual=passed jacobian=failed information_matrix=failed others=missing; 41: returns an array of which everything is masked.
# attack: lying; unlocked fails: only float64 bytes of the exact shape count.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    return np.ma.masked_all((graph.n_factors, graph.n_poses))


def information_matrix(graph):
    return np.ma.array(np.full((graph.n_factors, graph.n_factors), 7.5), mask=True)
