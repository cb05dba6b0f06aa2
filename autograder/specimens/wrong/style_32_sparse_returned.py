# expect: others=forbidden; style 32: scipy's sparse matrices are returned, and scipy is not allowed.
import numpy as np
from scipy import sparse


def residual(x, graph):
    return jacobian(x, graph) @ x + np.concatenate([graph.measurements, -graph.prior_means])


def jacobian(x, graph):
    k, m = len(graph.edges), graph.n_factors
    rows = np.concatenate([np.arange(k), np.arange(k), np.arange(k, m)])
    columns = np.concatenate([graph.edges[:, 0], graph.edges[:, 1], graph.priors])
    values = np.concatenate([np.ones(k), -np.ones(k), np.ones(m - k)])
    return sparse.csr_matrix((values, (rows, columns)), shape=(m, graph.n_poses))


def information_matrix(graph):
    return sparse.diags(1 / np.concatenate([graph.edge_variances, graph.prior_variances]))


def normal_equations(J, omega, f):
    J, omega = sparse.csr_matrix(J), sparse.csr_matrix(omega)
    return J.T @ omega @ J, J.T @ omega @ f


def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    return sparse.linalg.spsolve(H.tocsc(), -b)
