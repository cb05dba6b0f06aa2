# expect: others=passed; style 8: conjugate gradients until the rest is 1e-14 of the start.
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


def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    d = 1 / np.sqrt(np.diag(H))
    A = d[:, None] * H * d
    r = -d * b
    y = np.zeros(len(b))
    p = r.copy()
    rr = r @ r
    stop = 1e-28 * rr
    for _ in range(20 * len(b)):
        if rr <= stop:
            break
        Ap = A @ p
        alpha = rr / (p @ Ap)
        y = y + alpha * p
        r = r - alpha * Ap
        rr, old = r @ r, rr
        p = r + rr / old * p
    return d * y
