# expect: others=passed remark=row_sign; style 24: all rows turned, priors too, and J to match.
import numpy as np


def residual(x, graph):
    between = x[graph.edges[:, 1]] - x[graph.edges[:, 0]] - graph.measurements
    return np.concatenate([between, graph.prior_means - x[graph.priors]])


def jacobian(x, graph):
    eye = np.eye(graph.n_poses)
    return -np.concatenate([eye[graph.edges[:, 0]] - eye[graph.edges[:, 1]], eye[graph.priors]])


def information_matrix(graph):
    return np.diag(np.concatenate([1 / graph.edge_variances, 1 / graph.prior_variances]))


def normal_equations(J, omega, f):
    H = J.T @ omega @ J
    b = J.T @ omega @ f
    return H, b


def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    return np.linalg.solve(H, -b)
