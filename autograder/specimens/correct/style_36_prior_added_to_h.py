# expect: others=passed; style 36: the step adds the priors straight to H and b.
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
    return J


def information_matrix(graph):
    return np.diag(np.concatenate([1 / graph.edge_variances, 1 / graph.prior_variances]))


def normal_equations(J, omega, f):
    H = J.T @ omega @ J
    b = J.T @ omega @ f
    return H, b


def gauss_newton_step(x, graph):
    k = len(graph.edges)
    J, f = jacobian(x, graph)[:k], residual(x, graph)[:k]
    omega = np.diag(1 / graph.edge_variances)
    H, b = normal_equations(J, omega, f)
    for pose, mean, variance in zip(graph.priors, graph.prior_means, graph.prior_variances):
        H[pose, pose] += 1 / variance
        b[pose] += (x[pose] - mean) / variance
    return np.linalg.solve(H, -b)
