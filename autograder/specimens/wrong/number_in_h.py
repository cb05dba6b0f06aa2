# expect: gauss_newton_step=failed:h_entry_in_place_of_priors second_step=failed:number_in_h_holds_pose_0 others=passed; a number in H stands in place of the priors.
import numpy as np


def residual(x, graph):
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    k = len(graph.edges)
    i, j = graph.edges.T
    J = np.zeros((graph.n_factors, graph.n_poses))
    J[np.arange(k), i] = 1.0
    J[np.arange(k), j] = -1.0
    J[np.arange(k, graph.n_factors), graph.priors] = 1.0
    return J


def information_matrix(graph):
    return np.diag(1.0 / np.concatenate([graph.edge_variances, graph.prior_variances]))


def normal_equations(J, omega, f):
    return J.T @ omega @ J, J.T @ omega @ f


def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    return np.linalg.solve(H, -b)


def gauss_newton_step(x, graph):
    k = len(graph.edges)
    H, b = normal_equations(jacobian(x, graph)[:k], information_matrix(graph)[:k, :k], residual(x, graph)[:k])
    H[0, 0] += 1
    return np.linalg.solve(H, -b)
