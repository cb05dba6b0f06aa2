# expect: others=passed remark=rows; style 29: f, b and dx are rows of shape (1, m) and (1, n).
import numpy as np


def residual(x, graph):
    f = np.zeros((1, graph.n_factors))
    for r, (i, j) in enumerate(graph.edges):
        f[0, r] = x[i] + graph.measurements[r] - x[j]
    for r, k in enumerate(graph.priors):
        f[0, len(graph.edges) + r] = x[k] - graph.prior_means[r]
    return f


def jacobian(x, graph):
    J = np.zeros((graph.n_factors, graph.n_poses))
    for r, (i, j) in enumerate(graph.edges):
        J[r, i] = 1
        J[r, j] = -1
    for r, k in enumerate(graph.priors):
        J[len(graph.edges) + r, k] = 1
    return J


def information_matrix(graph):
    return np.diag(np.concatenate([1 / graph.edge_variances, 1 / graph.prior_variances]))


def normal_equations(J, omega, f):
    f = np.atleast_2d(f)
    return J.T @ omega @ J, f @ omega @ J


def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    return -b @ np.linalg.inv(H)
