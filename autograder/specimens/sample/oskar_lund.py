# expect: information_matrix=missing normal_equations=missing gauss_newton_step=missing second_step=missing others=passed; handed in half finished.
"""Unfinished: handed in before the deadline, two functions written."""

import numpy as np


def residual(x, graph):
    between = [x[i] + u - x[j] for (i, j), u in zip(graph.edges, graph.measurements)]
    prior = [x[k] - mean for k, mean in zip(graph.priors, graph.prior_means)]
    return np.array(between + prior)


def jacobian(x, graph):
    J = np.zeros((graph.n_factors, graph.n_poses))
    for r, (i, j) in enumerate(graph.edges):
        J[r, i] = 1
        J[r, j] = -1
    for r, k in enumerate(graph.priors):
        J[len(graph.edges) + r, k] = 1
    return J


def information_matrix(graph):
    raise NotImplementedError("write information_matrix")


def normal_equations(J, omega, f):
    raise NotImplementedError("write normal_equations")


def gauss_newton_step(x, graph):
    raise NotImplementedError("write gauss_newton_step")
