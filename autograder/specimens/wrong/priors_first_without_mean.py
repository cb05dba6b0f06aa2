# expect: residual=failed:prior_residual_without_mean gauss_newton_step=partial+follow_through second_step=partial+follow_through others=passed; the rows of the priors come first, and have no mean.
import numpy as np


def residual(x, graph):
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    k = len(graph.edges)
    i, j = graph.edges.T
    J = np.zeros((graph.n_factors, graph.n_poses))
    J[np.arange(k), i] = 1.0
    J[np.arange(k), j] = -1.0
    J[np.arange(k, graph.n_factors), graph.priors] = 1.0
    return J


def information_matrix(graph):
    return np.diag(1.0 / np.concatenate([graph.edge_variances, graph.prior_variances]))


def normal_equations(J, omega, f):
    return J.T @ omega @ J, J.T @ omega @ f


def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    return np.linalg.solve(H, -b)


def residual(x, graph):
    i, j = graph.edges.T
    return np.concatenate([x[graph.priors], x[i] + graph.measurements - x[j]])
