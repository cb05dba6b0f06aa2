# expect: others=passed; style 35: scatters with np.add.at.
import numpy as np


def residual(x, graph):
    f = np.zeros(graph.n_factors)
    for r, (i, j) in enumerate(graph.edges):
        f[r] = x[i] + graph.measurements[r] - x[j]
    for r, k in enumerate(graph.priors):
        f[len(graph.edges) + r] = x[k] - graph.prior_means[r]
    return f


def jacobian(x, graph):
    k = len(graph.edges)
    J = np.zeros((graph.n_factors, graph.n_poses))
    np.add.at(J, (np.arange(k), graph.edges[:, 0]), 1.0)
    np.add.at(J, (np.arange(k), graph.edges[:, 1]), -1.0)
    np.add.at(J, (np.arange(k, graph.n_factors), graph.priors), 1.0)
    return J


def information_matrix(graph):
    return np.diag(np.concatenate([1 / graph.edge_variances, 1 / graph.prior_variances]))


def normal_equations(J, omega, f):
    H = J.T @ omega @ J
    b = J.T @ omega @ f
    return H, b


def gauss_newton_step(x, graph):
    i, j = graph.edges.T
    w = 1 / graph.edge_variances
    f = residual(x, graph)[: len(w)]
    H = np.zeros((graph.n_poses, graph.n_poses))
    b = np.zeros(graph.n_poses)
    for a, c, s in ((i, i, 1), (j, j, 1), (i, j, -1), (j, i, -1)):
        np.add.at(H, (a, c), s * w)
    np.add.at(b, i, w * f)
    np.add.at(b, j, -w * f)
    np.add.at(H, (graph.priors, graph.priors), 1 / graph.prior_variances)
    np.add.at(b, graph.priors, (x[graph.priors] - graph.prior_means) / graph.prior_variances)
    return np.linalg.solve(H, -b)
