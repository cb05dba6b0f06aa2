# expect: residual=passed jacobian=error information_matrix=timeout normal_equations=error others=missing; 60: raises exceptions whose text raises, never ends, or is a gigabyte long.
# attack: leaving; unlocked left out: takes memory until the machine has none.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


class Raises(Exception):
    def __str__(self):
        raise self

    __repr__ = __str__


class Loops(Exception):
    def __str__(self):
        while True:
            pass


class Long(Exception):
    def __str__(self):
        return "passed " * (150 << 20)


def jacobian(x, graph):
    raise Raises


def information_matrix(graph):
    raise Loops


def normal_equations(J, omega, f):
    raise Long
