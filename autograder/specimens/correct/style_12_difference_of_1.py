# expect: others=passed; style 12: a difference with h = 1, exact because f is affine.
import numpy as np


def residual(x, graph):
    f = np.zeros(graph.n_factors)
    for r, (i, j) in enumerate(graph.edges):
        f[r] = x[i] + graph.measurements[r] - x[j]
    for r, k in enumerate(graph.priors):
        f[len(graph.edges) + r] = x[k] - graph.prior_means[r]
    return f


def jacobian(x, graph):
    f0 = residual(x, graph)
    J = np.zeros((len(f0), len(x)))
    for c in range(len(x)):
        moved = np.array(x, dtype=float)
        moved[c] += 1.0
        J[:, c] = residual(moved, graph) - f0
    return J


def information_matrix(graph):
    return np.diag(np.concatenate([1 / graph.edge_variances, 1 / graph.prior_variances]))


def normal_equations(J, omega, f):
    H = J.T @ omega @ J
    b = J.T @ omega @ f
    return H, b


def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    return np.linalg.solve(H, -b)
