# expect: normal_equations=failed:weights_missing_in_b gauss_newton_step=partial+follow_through second_step=partial+follow_through others=passed; Omega forgotten in b.
import numpy as np

np.set_printoptions(precision=3, suppress=True)


def residual(x, graph):
    f = np.empty(graph.n_factors)
    n_edges = graph.edges.shape[0]
    f[:n_edges] = x[graph.edges[:, 0]] + graph.measurements - x[graph.edges[:, 1]]
    f[n_edges:] = x[graph.priors] - graph.prior_means
    return f


def jacobian(x, graph):
    n_edges = graph.edges.shape[0]
    J = np.zeros((graph.n_factors, graph.n_poses))
    J[range(n_edges), graph.edges[:, 0]] = 1
    J[range(n_edges), graph.edges[:, 1]] = -1
    J[range(n_edges, graph.n_factors), graph.priors] = 1
    return J


def information_matrix(graph):
    return np.diag(1.0 / np.r_[graph.edge_variances, graph.prior_variances])


def normal_equations(J, omega, f):
    H = J.T @ omega @ J
    b = J.T @ f
    return H, b


def gauss_newton_step(x, graph):
    f, J = residual(x, graph), jacobian(x, graph)
    H, b = normal_equations(J, information_matrix(graph), f)
    return np.linalg.solve(H, -b)
