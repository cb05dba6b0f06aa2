# expect: gauss_newton_step=partial:step_rounded second_step=partial:rounded_step_stops_short others=passed; dx rounded to four decimals.
import numpy as np


def residual(x, graph):
    i, j = graph.edges.T
    return np.append(x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means)


def jacobian(x, graph):
    m, n, k = graph.n_factors, graph.n_poses, len(graph.edges)
    J = np.zeros((m, n))
    for r in range(m):
        if r < k:
            i, j = graph.edges[r]
            J[r, i] = 1
            J[r, j] = -1
        else:
            J[r, graph.priors[r - k]] = 1
    return J


def information_matrix(graph):
    return np.diag(1 / np.append(graph.edge_variances, graph.prior_variances))


def normal_equations(J, omega, f):
    return J.T @ omega @ J, J.T @ omega @ f


def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    dx = np.linalg.solve(H, -b)
    return np.round(dx, 4)


# My answers, for the worked example.
iterates = np.array([[0, 1.1, 2.1, 3.2, 0.5], [0, 1.0, 1.9, 2.9, 0.1], [0, 1.0, 1.9, 2.9, 0.1], [0, 1.0, 1.9, 2.9, 0.1]])
conclusion = "C"
written_2 = "The second step is zero to four decimals."
written_3 = "The residual is linear in x."
