# expect: residual=passed jacobian=failed others=missing remark=lists; 42: returns floats whose arithmetic is made up.
# attack: lying; unlocked fails: only float64 bytes of the exact shape count.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


class Liar(float):
    def __sub__(self, other):
        return Liar(0)

    def __abs__(self):
        return Liar(0)

    def __float__(self):
        return 0.0

    __rsub__ = __sub__


def jacobian(x, graph):
    return [[Liar(7.5)] * graph.n_poses] * graph.n_factors
