# expect: jacobian=failed:jacobian_transposed others=passed; J transposed, and turned back before it is used.
import numpy as np


def residual(x, graph):
    f = np.zeros(graph.n_factors)
    for r in range(len(graph.edges)):
        i, j = graph.edges[r]
        f[r] = x[i] + graph.measurements[r] - x[j]
    for r in range(len(graph.priors)):
        f[len(graph.edges) + r] = x[graph.priors[r]] - graph.prior_means[r]
    return f


def jacobian(x, graph):
    # a column for every factor
    J = np.zeros((graph.n_poses, graph.n_factors))
    for r, (i, j) in enumerate(graph.edges):
        J[i, r] = 1
        J[j, r] = -1
    for r, k in enumerate(graph.priors):
        J[k, len(graph.edges) + r] = 1
    return J


def information_matrix(graph):
    return np.diag(np.append(graph.edge_variances, graph.prior_variances) ** -1.0)


def normal_equations(J, omega, f):
    H = J.T @ omega @ J
    b = J.T @ omega @ f
    return H, b


def gauss_newton_step(x, graph):
    J = jacobian(x, graph)
    H, b = normal_equations(J.T, information_matrix(graph), residual(x, graph))
    return np.linalg.solve(H, -b)


# My answers, for the worked example.
iterates = np.array([[0, 1.1, 2.1, 3.2, 0.5], [0, 1.0, 1.9, 2.9, 0.1], [0, 1.0, 1.9, 2.9, 0.1], [0, 1.0, 1.9, 2.9, 0.1]])
conclusion = "C"
written_2 = "No change after x^(1)."
written_3 = "It is linear."
