# expect: others=passed remark=columns; whitened QR, columns for vectors, differences for J.
"""Whitened: a factor divided by its standard deviation, then ordinary least squares."""

import numpy as np
from numpy.linalg import qr


def residual(x, graph):
    x = np.asarray(x, dtype=float).reshape(-1, 1)
    i, j = graph.edges.T
    between = x[i] + graph.measurements[:, None] - x[j]
    prior = x[graph.priors] - graph.prior_means[:, None]
    return np.vstack([between, prior])  # a column, as in the lecture


def jacobian(x, graph):
    # the residual is affine in x, so a difference with step 1 is the derivative
    f0 = residual(np.zeros(graph.n_poses), graph)
    columns = [residual(e, graph) - f0 for e in np.eye(graph.n_poses)]
    return np.hstack(columns)


def information_matrix(graph):
    sigma = np.sqrt(np.concatenate([graph.edge_variances, graph.prior_variances]))
    whiten = np.diag(1 / sigma)
    return whiten.T @ whiten


def normal_equations(J, omega, f):
    H = np.einsum("ri,rs,sj->ij", J, omega, J)
    b = np.einsum("ri,rs,s->i", J, omega, np.ravel(f))
    return H, b


def gauss_newton_step(x, graph):
    root = np.sqrt(information_matrix(graph))
    Q, R = qr(root @ jacobian(x, graph))
    return np.linalg.solve(R, -Q.T @ (root @ residual(x, graph)))


# My answers, for the worked example.
iterates = np.array([[0, 1.1, 2.1, 3.2, 0.5], [0, 1.0, 1.9, 2.9, 0.1], [0, 1.0, 1.9, 2.9, 0.1], [0, 1.0, 1.9, 2.9, 0.1]])
conclusion = "C"
written_2 = "x^(2) and x^(3) equal x^(1)."
written_3 = "J does not depend on x. With a range to a beacon beside the line it would."
