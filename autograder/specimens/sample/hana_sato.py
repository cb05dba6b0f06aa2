# expect: jacobian=failed:prior_row_missing gauss_newton_step=partial+follow_through second_step=partial+follow_through others=passed; J has no rows for the priors.
import numpy as np


def residual(x, graph):
    i = graph.edges[:, 0]
    j = graph.edges[:, 1]
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    k = len(graph.edges)
    J = np.zeros((k, graph.n_poses))
    for r, (i, j) in enumerate(graph.edges):
        J[r, i] = 1.0
        J[r, j] = -1.0
    return J


def information_matrix(graph):
    return np.diag(1 / np.concatenate([graph.edge_variances, graph.prior_variances]))


def normal_equations(J, omega, f):
    return J.T @ omega @ J, J.T @ omega @ f


def gauss_newton_step(x, graph):
    J = jacobian(x, graph)
    H, b = normal_equations(J, information_matrix(graph), residual(x, graph))
    return np.linalg.solve(H, -b)
