# expect: residual=passed jacobian=failed information_matrix=failed normal_equations=failed gauss_newton_step=failed second_step=failed others=missing; 45: returns NaN and infinities.
# attack: lying; unlocked fails: only float64 bytes of the exact shape count.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    return np.full((graph.n_factors, graph.n_poses), np.nan)


def information_matrix(graph):
    return np.full((graph.n_factors, graph.n_factors), np.inf)


def normal_equations(J, omega, f):
    n = J.shape[1]
    return np.full((n, n), -np.inf), np.full(n, np.nan)


def gauss_newton_step(x, graph):
    return np.full(graph.n_poses, np.nan)
