# expect: others=passed; style 19: a prior is an edge to a ground node whose column is dropped.
import numpy as np


def grounded(graph):
    ground = graph.n_poses
    edges = [(i, j, u) for (i, j), u in zip(graph.edges, graph.measurements)]
    edges += [(k, ground, -mean) for k, mean in zip(graph.priors, graph.prior_means)]
    return edges


def residual(x, graph):
    x = np.append(x, 0.0)
    return np.array([x[i] + u - x[j] for i, j, u in grounded(graph)])


def jacobian(x, graph):
    edges = grounded(graph)
    J = np.zeros((len(edges), graph.n_poses + 1))
    for r, (i, j, _) in enumerate(edges):
        J[r, i], J[r, j] = 1.0, -1.0
    return J[:, :-1]


def information_matrix(graph):
    return np.diag(np.concatenate([1 / graph.edge_variances, 1 / graph.prior_variances]))


def normal_equations(J, omega, f):
    H = J.T @ omega @ J
    b = J.T @ omega @ f
    return H, b


def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    return np.linalg.solve(H, -b)
