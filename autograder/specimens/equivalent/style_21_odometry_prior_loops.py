# expect: others=passed remark=row_order; style 21: odometry, then priors, then loops.
import numpy as np


def split(graph):
    odometry = [r for r, (i, j) in enumerate(graph.edges) if abs(i - j) == 1]
    loops = [r for r in range(len(graph.edges)) if r not in odometry]
    return odometry, loops


def residual(x, graph):
    odometry, loops = split(graph)
    between = x[graph.edges[:, 0]] + graph.measurements - x[graph.edges[:, 1]]
    prior = x[graph.priors] - graph.prior_means
    return np.concatenate([between[odometry], prior, between[loops]])


def jacobian(x, graph):
    odometry, loops = split(graph)
    eye = np.eye(graph.n_poses)
    between = eye[graph.edges[:, 0]] - eye[graph.edges[:, 1]]
    return np.concatenate([between[odometry], eye[graph.priors], between[loops]])


def information_matrix(graph):
    odometry, loops = split(graph)
    w = 1 / graph.edge_variances
    return np.diag(np.concatenate([w[odometry], 1 / graph.prior_variances, w[loops]]))


def normal_equations(J, omega, f):
    H = J.T @ omega @ J
    b = J.T @ omega @ f
    return H, b


def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    return np.linalg.solve(H, -b)
