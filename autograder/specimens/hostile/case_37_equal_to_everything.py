# expect: residual=passed jacobian=failed information_matrix=failed others=missing; 37: returns an object that says that it is equal to everything.
# attack: lying; unlocked fails: only float64 bytes of the exact shape count.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


class Equal:
    shape, dtype, ndim, size = (4,), np.dtype(float), 1, 4

    def __eq__(self, other):
        return True

    def __array__(self, *_, **__):
        return self

    def __len__(self):
        return 4

    def __bool__(self):
        return True

    def __float__(self):
        return 0.0

    __le__ = __lt__ = __ge__ = __gt__ = __eq__
    __sub__ = __rsub__ = __abs__ = lambda self, *_: self


def jacobian(x, graph):
    return Equal()


def information_matrix(graph):
    return [[Equal()] * graph.n_factors] * graph.n_factors
