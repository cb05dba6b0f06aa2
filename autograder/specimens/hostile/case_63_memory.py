# expect: residual=passed jacobian=memory information_matrix=memory normal_equations=memory others=missing; 63: asks for 8 GiB, doubles a list, and fills memory bit by bit.
# attack: exhaustion; unlocked left out: takes memory until the machine has none.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    return np.ones(2**30)


def information_matrix(graph):
    filled = [0]
    while True:
        filled += filled


def normal_equations(J, omega, f):
    kept = []
    while True:
        kept.append(np.empty(1 << 20))


TEXT = "x" * 10**10
