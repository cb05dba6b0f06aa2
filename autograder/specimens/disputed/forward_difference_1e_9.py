# expect: jacobian=partial:difference_step_too_small gauss_newton_step=partial+follow_through second_step=partial+follow_through others=passed; J11 of the catalogue: a forward difference with h = 1e-9.
import numpy as np


def residual(x, graph):
    f = np.zeros(graph.n_factors)
    for r, (i, j) in enumerate(graph.edges):
        f[r] = x[i] + graph.measurements[r] - x[j]
    for r, k in enumerate(graph.priors):
        f[len(graph.edges) + r] = x[k] - graph.prior_means[r]
    return f


def jacobian(x, graph):
    h = 1e-9
    J = np.zeros((graph.n_factors, graph.n_poses))
    for c in range(graph.n_poses):
        e = np.zeros(graph.n_poses)
        e[c] = h
        J[:, c] = (residual(x + e, graph) - residual(x, graph)) / h
    return J


def information_matrix(graph):
    return np.diag(np.concatenate([1 / graph.edge_variances, 1 / graph.prior_variances]))


def normal_equations(J, omega, f):
    H = J.T @ omega @ J
    b = J.T @ omega @ f
    return H, b


def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    return np.linalg.solve(H, -b)
