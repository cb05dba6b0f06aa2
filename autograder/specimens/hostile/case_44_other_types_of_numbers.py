# expect: residual=passed jacobian=failed information_matrix=failed normal_equations=failed gauss_newton_step=failed second_step=failed others=missing remark=reduced_precision remark=truth_values; 44: returns texts, dates, records and truth values in the place of numbers.
# attack: lying; unlocked fails: only float64 bytes of the exact shape count.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    return np.full((graph.n_factors, graph.n_poses), 1.0).astype("U8")


def information_matrix(graph):
    return np.ones((graph.n_factors, graph.n_factors), bool)


def normal_equations(J, omega, f):
    n = J.shape[1]
    return np.zeros((n, n), "datetime64[s]"), np.zeros(n, [("a", float)])


def gauss_newton_step(x, graph):
    return np.full(graph.n_poses, 7.5, np.float16)
