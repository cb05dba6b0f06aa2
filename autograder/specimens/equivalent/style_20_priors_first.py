# expect: others=passed remark=row_order; style 20: the rows of the priors come first in f, J and Omega.
import numpy as np


def residual(x, graph):
    f = [x[k] - mean for k, mean in zip(graph.priors, graph.prior_means)]
    for (i, j), u in zip(graph.edges, graph.measurements):
        f.append(x[i] + u - x[j])
    return np.array(f)


def jacobian(x, graph):
    p = len(graph.priors)
    J = np.zeros((graph.n_factors, graph.n_poses))
    J[np.arange(p), graph.priors] = 1
    for r, (i, j) in enumerate(graph.edges):
        J[p + r, i] = 1
        J[p + r, j] = -1
    return J


def information_matrix(graph):
    return np.diag(1 / np.concatenate([graph.prior_variances, graph.edge_variances]))


def normal_equations(J, omega, f):
    H = J.T @ omega @ J
    b = J.T @ omega @ f
    return H, b


def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    return np.linalg.solve(H, -b)
