# expect: others=passed; one statement at the top raises, for the file that it reads is not there.
import numpy as np

measurements = np.loadtxt("odometry.txt")  # my own copy of the numbers, next to this file


def residual(x, graph):
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    J = np.zeros((graph.n_factors, graph.n_poses))
    for r, (i, j) in enumerate(graph.edges):
        J[r, i] += 1
        J[r, j] -= 1
    for r, k in enumerate(graph.priors, start=len(graph.edges)):
        J[r, k] += 1
    return J


def information_matrix(graph):
    return np.diag(1 / np.concatenate([graph.edge_variances, graph.prior_variances]))


def normal_equations(J, omega, f):
    # sum of outer products, one factor after the other
    n = J.shape[1]
    H, b = np.zeros((n, n)), np.zeros(n)
    for row, weight, value in zip(J, np.diag(omega), f):
        H += weight * np.outer(row, row)
        b += weight * value * row
    return H, b


def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    L = np.linalg.cholesky(H)
    return np.linalg.solve(L.T, np.linalg.solve(L, -b))


# My answers, for the worked example.
iterates = np.array([[0, 1.1, 2.1, 3.2, 0.5], [0, 1.0, 1.9, 2.9, 0.1], [0, 1.0, 1.9, 2.9, 0.1], [0, 1.0, 1.9, 2.9, 0.1]])
conclusion = "E"
written_2 = "The step becomes zero after the first one."
written_3 = "Because we started from dead reckoning, which is already good."
