# expect: others=passed; style 17: exact fractions, then float.
from fractions import Fraction

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
    m, n = J.shape
    J = [[Fraction(float(v)) for v in row] for row in J]
    w = [Fraction(float(omega[r, r])) for r in range(m)]
    f = [Fraction(float(v)) for v in f]
    wJ = [[w[r] * v for v in J[r]] for r in range(m)]
    H = np.zeros((n, n))
    b = np.zeros(n)
    for a in range(n):
        used = [r for r in range(m) if J[r][a]]
        for c in range(a, n):
            H[a, c] = H[c, a] = float(sum((wJ[r][a] * J[r][c] for r in used if J[r][c]), Fraction(0)))
        b[a] = float(sum((wJ[r][a] * f[r] for r in used), Fraction(0)))
    return H, b


def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    return np.linalg.solve(H, -b)
