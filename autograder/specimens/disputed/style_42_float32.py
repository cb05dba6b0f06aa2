# expect: residual=failed:residual_in_single_precision information_matrix=failed:information_in_single_precision normal_equations=partial:normal_equations_in_single_precision gauss_newton_step=partial+follow_through second_step=partial+follow_through others=passed remark=reduced_precision; style 42: single precision throughout.
import numpy as np


def residual(x, graph):
    x = x.astype(np.float32)
    i, j = graph.edges.T
    between = x[i] + graph.measurements.astype(np.float32) - x[j]
    return np.concatenate([between, x[graph.priors] - graph.prior_means.astype(np.float32)])


def jacobian(x, graph):
    J = np.zeros((graph.n_factors, graph.n_poses), dtype=np.float32)
    for r, (i, j) in enumerate(graph.edges):
        J[r, i] = 1
        J[r, j] = -1
    for r, k in enumerate(graph.priors):
        J[len(graph.edges) + r, k] = 1
    return J


def information_matrix(graph):
    variances = np.concatenate([graph.edge_variances, graph.prior_variances]).astype(np.float32)
    return np.diag(1 / variances)


def normal_equations(J, omega, f):
    J, omega, f = J.astype(np.float32), omega.astype(np.float32), f.astype(np.float32)
    return J.T @ omega @ J, J.T @ omega @ f


def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    return np.linalg.solve(H, -b)
