# expect: gauss_newton_step=timeout second_step=timeout others=passed; iterates until every measurement agrees, so for ever.
import numpy as np


def residual(x, graph):
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    J = np.zeros((graph.n_factors, graph.n_poses))
    for r, (i, j) in enumerate(graph.edges):
        J[r, i], J[r, j] = 1, -1
    for r, k in enumerate(graph.priors):
        J[len(graph.edges) + r, k] = 1
    return J


def information_matrix(graph):
    return np.diag(1 / np.concatenate([graph.edge_variances, graph.prior_variances]))


def normal_equations(J, omega, f):
    return J.T @ omega @ J, J.T @ omega @ f


def gauss_newton_step(x, graph):
    total = np.zeros_like(x)
    error = 1.0
    while error != 0:  # until every measurement agrees
        H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x + total, graph))
        total = total + np.linalg.solve(H, -b)
        f = residual(x + total, graph)
        error = f @ f
    return total
