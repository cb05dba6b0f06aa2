# expect: information_matrix=failed gauss_newton_step=missing second_step=missing others=passed; one weight instead of a matrix of them.
import numpy as np
def residual(x, graph):
    i, j = graph.edges.T
    return np.r_[x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means]
def jacobian(x, graph):
    I = np.eye(graph.n_poses)
    return np.vstack([I[graph.edges[:, 0]] - I[graph.edges[:, 1]], I[graph.priors]])
def information_matrix(graph):
    return 100.0
def normal_equations(J, omega, f):
    return J.T @ omega @ J, J.T @ omega @ f
