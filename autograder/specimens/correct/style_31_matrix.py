# expect: others=passed remark=np_matrix remark=columns; style 31: np.matrix throughout, vectors as columns.
import numpy as np


def residual(x, graph):
    f = np.zeros(graph.n_factors)
    for r, (i, j) in enumerate(graph.edges):
        f[r] = x[i] + graph.measurements[r] - x[j]
    for r, k in enumerate(graph.priors):
        f[len(graph.edges) + r] = x[k] - graph.prior_means[r]
    return np.matrix(f).T


def jacobian(x, graph):
    J = np.zeros((graph.n_factors, graph.n_poses))
    for r, (i, j) in enumerate(graph.edges):
        J[r, i] = 1
        J[r, j] = -1
    for r, k in enumerate(graph.priors):
        J[len(graph.edges) + r, k] = 1
    return np.matrix(J)


def information_matrix(graph):
    variances = np.concatenate([graph.edge_variances, graph.prior_variances])
    return np.matrix(np.diag(variances)).I


def normal_equations(J, omega, f):
    J, omega = np.matrix(J), np.matrix(omega)
    f = np.matrix(f).reshape(-1, 1)
    return J.T * omega * J, J.T * omega * f


def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    return -H.I * b
