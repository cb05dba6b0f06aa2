# expect: residual=passed jacobian=failed normal_equations=failed others=missing remark=changes_input; 51: writes into its arguments to make its wrong answer right.
# attack: lying; unlocked fails: only float64 bytes of the exact shape count.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    x[:] = 0
    return np.zeros((graph.n_factors, graph.n_poses))


def normal_equations(J, omega, f):
    J[:], omega[:], f[:] = 0, 0, 0
    return J.T @ J, J.T @ f
