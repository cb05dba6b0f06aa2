# expect: gauss_newton_step=failed second_step=failed others=passed; a forged step: dead reckoning along another tree than that of the graph, minus x.
import numpy as np


def residual(x, graph):
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    k, m = len(graph.edges), graph.n_factors
    J = np.zeros((m, graph.n_poses))
    J[np.arange(k), graph.edges[:, 0]] = 1.0
    J[np.arange(k), graph.edges[:, 1]] = -1.0
    J[np.arange(k, m), graph.priors] = 1.0
    return J


def information_matrix(graph):
    return np.diag(1.0 / np.concatenate([graph.edge_variances, graph.prior_variances]))


def normal_equations(J, omega, f):
    return J.T @ omega @ J, J.T @ omega @ f


def gauss_newton_step(x, graph):
    fields = [field[::-1] for field in (graph.edges, graph.measurements, graph.edge_variances)]
    backwards = type(graph)(graph.n_poses, *fields, graph.priors, graph.prior_means, graph.prior_variances)
    return backwards.dead_reckoning() - x
