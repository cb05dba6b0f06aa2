# expect: residual=passed jacobian=failed others=missing; 39: returns a subclass of ndarray that answers for numpy's own functions.
# attack: lying; unlocked fails: only float64 bytes of the exact shape count.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


class Liar(np.ndarray):
    def __array_ufunc__(self, *_, **__):
        return True

    def __array_function__(self, *_, **__):
        return True

    def __array_finalize__(self, other):
        pass

    def __array_wrap__(self, *_):
        return True

    shape = property(lambda self: (4, 4))


def jacobian(x, graph):
    return np.full((graph.n_factors, graph.n_poses), 7.5).view(Liar)
