# expect: others=passed remark=lists; style 30: everything is returned as lists.
import numpy as np


def residual(x, graph):
    f = [float(x[i] + u - x[j]) for (i, j), u in zip(graph.edges, graph.measurements)]
    return f + [float(x[k] - mean) for k, mean in zip(graph.priors, graph.prior_means)]


def jacobian(x, graph):
    J = [[0.0] * graph.n_poses for _ in range(graph.n_factors)]
    for r, (i, j) in enumerate(graph.edges):
        J[r][i], J[r][j] = 1.0, -1.0
    for r, k in enumerate(graph.priors, len(graph.edges)):
        J[r][k] = 1.0
    return J


def information_matrix(graph):
    m = graph.n_factors
    variances = list(graph.edge_variances) + list(graph.prior_variances)
    return [[1.0 / variances[r] if r == c else 0.0 for c in range(m)] for r in range(m)]


def normal_equations(J, omega, f):
    J, omega, f = np.array(J), np.array(omega), np.array(f)
    return (J.T @ omega @ J).tolist(), (J.T @ omega @ f).tolist()


def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    return np.linalg.solve(np.array(H), -np.array(b)).tolist()
