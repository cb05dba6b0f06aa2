# expect: information_matrix=failed:covariance_used_as_information gauss_newton_step=partial+follow_through others=passed; covariance used as information.
import numpy as np


def residual(x, graph):
    edges = [x[i] + u - x[j] for (i, j), u in zip(graph.edges, graph.measurements)]
    priors = [x[k] - p for k, p in zip(graph.priors, graph.prior_means)]
    return np.array(edges + priors)


def jacobian(x, graph):
    J = np.zeros((graph.n_factors, graph.n_poses))
    row = 0
    for i, j in graph.edges:
        J[row, i], J[row, j] = 1, -1
        row += 1
    for k in graph.priors:
        J[row, k] = 1
        row += 1
    return J


def information_matrix(graph):
    # the uncertainty of every measurement stands on the diagonal
    return np.diag(list(graph.edge_variances) + list(graph.prior_variances))


def normal_equations(J, omega, f):
    return J.T @ omega @ J, J.T @ omega @ f


def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    return np.linalg.solve(H, -b)


# My answers, for the worked example.
iterates = np.array([[0, 1.1, 2.1, 3.2, 0.5], [0, 1.0, 1.9, 2.9, 0.1], [0, 1.0, 1.9, 2.9, 0.1], [0, 1.0, 1.9, 2.9, 0.1]])
conclusion = "A"
written_2 = "It is the same after one step."
written_3 = "It has reached the true positions."
