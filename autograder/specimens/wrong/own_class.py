# expect: information_matrix=failed gauss_newton_step=partial+follow_through second_step=partial+follow_through others=passed; Omega is an object of a class of its own.
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


class matrix:
    def __init__(self, value): self.value = value
def information_matrix(graph):
    v = np.concatenate([graph.edge_variances, graph.prior_variances])
    return matrix([[1 / v[r] if r == c else 0.0 for c in range(len(v))] for r in range(len(v))])
