# expect: residual=passed jacobian=failed information_matrix=failed normal_equations=failed gauss_newton_step=failed second_step=failed others=missing; 48: returns None, an empty array, and a generator.
# attack: lying; unlocked fails: only float64 bytes of the exact shape count.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    return None


def information_matrix(graph):
    return np.array([])


def normal_equations(J, omega, f):
    return (value for value in range(2))


def gauss_newton_step(x, graph):
    return iter([0.0] * graph.n_poses)
