# expect: others=passed; style 2: no loops, and Omega is a vector of weights inside the step.
import numpy as np


def residual(x, graph):
    i, j = graph.edges[:, 0], graph.edges[:, 1]
    return np.hstack([x[i] - x[j] + graph.measurements, x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    one = np.eye(graph.n_poses)
    return np.vstack([one[graph.edges[:, 0]] - one[graph.edges[:, 1]], one[graph.priors]])


def weights(graph):
    return 1.0 / np.hstack([graph.edge_variances, graph.prior_variances])


def information_matrix(graph):
    return np.diag(weights(graph))


def normal_equations(J, omega, f):
    H = J.T @ omega @ J
    b = J.T @ omega @ f
    return H, b


def gauss_newton_step(x, graph):
    J, w = jacobian(x, graph), weights(graph)
    return np.linalg.solve((J.T * w) @ J, -(J.T * w) @ residual(x, graph))
