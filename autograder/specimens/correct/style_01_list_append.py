# expect: others=passed; style 1: rows are appended to lists.
import numpy as np


def residual(x, graph):
    rows = []
    for (i, j), u in zip(graph.edges, graph.measurements):
        rows.append(x[i] + u - x[j])
    for k, mean in zip(graph.priors, graph.prior_means):
        rows.append(x[k] - mean)
    return np.array(rows)


def jacobian(x, graph):
    rows = []
    for i, j in graph.edges:
        row = [0.0] * graph.n_poses
        row[i] = 1.0
        row[j] = -1.0
        rows.append(row)
    for k in graph.priors:
        row = [0.0] * graph.n_poses
        row[k] = 1.0
        rows.append(row)
    return np.array(rows)


def information_matrix(graph):
    weights = []
    for v in graph.edge_variances:
        weights.append(1 / v)
    for v in graph.prior_variances:
        weights.append(1 / v)
    return np.diag(weights)


def normal_equations(J, omega, f):
    H = J.T @ omega @ J
    b = J.T @ omega @ f
    return H, b


def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    return np.linalg.solve(H, -b)
