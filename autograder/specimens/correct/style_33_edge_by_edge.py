# expect: others=passed; style 33: the step adds up H and b edge by edge.
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
    H = np.zeros((graph.n_poses, graph.n_poses))
    b = np.zeros(graph.n_poses)
    for (i, j), u, v in zip(graph.edges, graph.measurements, graph.edge_variances):
        r = x[i] + u - x[j]
        H[i, i] += 1 / v
        H[j, j] += 1 / v
        H[i, j] -= 1 / v
        H[j, i] -= 1 / v
        b[i] += r / v
        b[j] -= r / v
    for k, mean, v in zip(graph.priors, graph.prior_means, graph.prior_variances):
        H[k, k] += 1 / v
        b[k] += (x[k] - mean) / v
    return np.linalg.solve(H, -b)
