# expect: residual=failed:residual_whitened jacobian=failed:jacobian_whitened information_matrix=failed:identity_used_as_information others=passed; f and J are whitened, with the sign turned.
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
    s = np.sqrt(np.concatenate([graph.edge_variances, graph.prior_variances]))
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means]) / -s
def jacobian(x, graph):
    d = np.eye(len(x))
    return np.array([residual(x + e, graph) - residual(x, graph) for e in d]).T
def information_matrix(graph):
    return np.eye(graph.n_factors)
