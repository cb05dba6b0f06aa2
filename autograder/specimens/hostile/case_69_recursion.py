# expect: residual=passed jacobian=ended information_matrix=failed normal_equations=error others=missing; 69: takes the bound off recursion and calls itself, in Python and in C.
# attack: exhaustion; unlocked left out: takes memory until the machine has none.
import sys

import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


sys.setrecursionlimit(2**31 - 1)
DEEP = ()
for _ in range(200_000):
    DEEP = (DEEP,)


def jacobian(x, graph):
    return jacobian(x, graph)


def information_matrix(graph):
    return DEEP


def normal_equations(J, omega, f):
    return hash(DEEP), repr(DEEP)
