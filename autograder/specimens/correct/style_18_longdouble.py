# expect: others=passed; style 18: extended precision throughout, returned as it is.
import numpy as np


def residual(x, graph):
    x = np.asarray(x, dtype=np.longdouble)
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    J = np.zeros((graph.n_factors, graph.n_poses), dtype=np.longdouble)
    for r, (i, j) in enumerate(graph.edges):
        J[r, i] = 1
        J[r, j] = -1
    for r, k in enumerate(graph.priors):
        J[len(graph.edges) + r, k] = 1
    return J


def information_matrix(graph):
    variances = np.concatenate([graph.edge_variances, graph.prior_variances])
    return np.diag(1 / variances.astype(np.longdouble))


def normal_equations(J, omega, f):
    H = J.T @ omega @ J
    b = J.T @ omega @ f
    return H, b


def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    return np.linalg.solve(H.astype(float), -b.astype(float))
