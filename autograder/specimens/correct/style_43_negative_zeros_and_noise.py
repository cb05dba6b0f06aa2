# expect: others=passed; style 43: -0.0 and noise of 1e-17 in all entries.
import numpy as np


def residual(x, graph):
    f = np.zeros(graph.n_factors)
    for r, (i, j) in enumerate(graph.edges):
        f[r] = x[i] + graph.measurements[r] - x[j]
    for r, k in enumerate(graph.priors):
        f[len(graph.edges) + r] = x[k] - graph.prior_means[r]
    return f


def jacobian(x, graph):
    J = np.zeros((graph.n_factors, graph.n_poses))
    for r, (i, j) in enumerate(graph.edges):
        J[r, i] = 1
        J[r, j] = -1
    for r, k in enumerate(graph.priors):
        J[len(graph.edges) + r, k] = 1
    return -(-J) * 1.0 - 1e-17 * (J == 0)


def information_matrix(graph):
    omega = -np.diag(-1 / np.concatenate([graph.edge_variances, graph.prior_variances]))
    omega[omega == 0] = -0.0
    return omega


def normal_equations(J, omega, f):
    H = J.T @ omega @ J
    return H + 1e-17 * np.sin(np.arange(H.size)).reshape(H.shape), -(J.T @ omega @ -f)


def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    return np.linalg.solve(H, -b)
