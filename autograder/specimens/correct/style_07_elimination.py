# expect: others=passed; style 7: eliminates by hand.
import numpy as np


def residual(x, graph):
    f = np.zeros(graph.n_factors)
    for r, (i, j) in enumerate(graph.edges):
        f[r] = x[i] + graph.measurements[r] - x[j]
    for r, k in enumerate(graph.priors):
        f[len(graph.edges) + r] = x[k] - graph.prior_means[r]
    return f


def jacobian(x, graph):
    J = np.zeros((graph.n_factors, graph.n_poses))
    for r, (i, j) in enumerate(graph.edges):
        J[r, i] = 1
        J[r, j] = -1
    for r, k in enumerate(graph.priors):
        J[len(graph.edges) + r, k] = 1
    return J


def information_matrix(graph):
    return np.diag(np.concatenate([1 / graph.edge_variances, 1 / graph.prior_variances]))


def normal_equations(J, omega, f):
    H = J.T @ omega @ J
    b = J.T @ omega @ f
    return H, b


def solve_by_hand(A, rhs):
    A = A.astype(float).copy()
    y = rhs.astype(float).copy()
    n = len(y)
    for k in range(n):
        p = k + np.argmax(abs(A[k:, k]))
        A[[k, p]] = A[[p, k]]
        y[[k, p]] = y[[p, k]]
        for r in range(k + 1, n):
            m = A[r, k] / A[k, k]
            A[r] -= m * A[k]
            y[r] -= m * y[k]
    out = np.zeros(n)
    for k in range(n - 1, -1, -1):
        out[k] = (y[k] - A[k, k + 1:] @ out[k + 1:]) / A[k, k]
    return out


def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    return solve_by_hand(H, -b)
