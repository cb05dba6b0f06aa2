# expect: residual=passed jacobian=failed others=missing; 38: returns a subclass of ndarray whose comparison is always true.
# attack: lying; unlocked fails: only float64 bytes of the exact shape count.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


class Liar(np.ndarray):
    def __eq__(self, other):
        return np.ones(self.shape, bool)

    def tobytes(self, order="C"):
        return b""

    __le__ = __lt__ = __eq__


def jacobian(x, graph):
    return np.full((graph.n_factors, graph.n_poses), 7.5).view(Liar)
