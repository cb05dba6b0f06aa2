# expect: residual=passed jacobian=failed information_matrix=failed:weights_in_a_vector normal_equations=failed gauss_newton_step=failed second_step=failed others=missing; 46: returns arrays that would broadcast to the right shape.
# attack: lying; unlocked fails: only float64 bytes of the exact shape count.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    return np.zeros((1, graph.n_poses))


def information_matrix(graph):
    return 1 / np.concatenate([graph.edge_variances, graph.prior_variances])


def normal_equations(J, omega, f):
    return 0.0, np.zeros((1, 1, 1))


def gauss_newton_step(x, graph):
    return np.zeros((2, graph.n_poses, 1))
