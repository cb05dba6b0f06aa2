# expect: others=passed; guards against dividing by 0 and against a singular H, too small to matter.
import numpy as np


def residual(x, graph):
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    k = len(graph.edges)
    J = np.zeros((graph.n_factors, graph.n_poses))
    for row, (i, j) in enumerate(graph.edges):
        J[row, i] += 1.0
        J[row, j] -= 1.0
    for row, pose in enumerate(graph.priors):
        J[k + row, pose] += 1.0
    return J


def information_matrix(graph):
    variances = np.concatenate([graph.edge_variances, graph.prior_variances])
    return np.diag(1.0 / (np.maximum(variances, 1e-12) + 1e-12))


def normal_equations(J, omega, f):
    H = J.T @ omega @ J
    H += 1e-9 * H.max() * np.eye(len(H))
    return H, J.T @ omega @ f


def gauss_newton_step(x, graph):
    J = jacobian(x, graph)
    omega = information_matrix(graph)
    H = J.T @ omega @ J + 1e-9 * np.eye(graph.n_poses)
    b = J.T @ omega @ residual(x, graph)
    return np.linalg.solve(H, -b)
