# expect: residual=failed gauss_newton_step=missing second_step=missing others=passed; f = ... for f[r] = ..., so one number is returned.
import numpy as np
def residual(x, graph):
    for (i, j), u in zip(graph.edges, graph.measurements):
        f = x[i] + u - x[j]
    return f
def jacobian(x, graph):
    I = np.eye(graph.n_poses)
    return np.vstack([I[graph.edges[:, 0]] - I[graph.edges[:, 1]], I[graph.priors]])
def information_matrix(graph):
    return np.diag(1 / np.r_[graph.edge_variances, graph.prior_variances])
def normal_equations(J, omega, f):
    return J.T @ omega @ J, J.T @ omega @ f
