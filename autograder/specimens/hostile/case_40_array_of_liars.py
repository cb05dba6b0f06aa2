# expect: residual=passed jacobian=failed information_matrix=failed others=missing; 40: returns an array of objects that compare as they like.
# attack: lying; unlocked fails: only float64 bytes of the exact shape count.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


class Liar(float):
    def __eq__(self, other):
        return True

    def __float__(self):
        return 0.0

    __hash__ = None


class Other:
    def __float__(self):
        return 0.0

    def __eq__(self, other):
        return True


def jacobian(x, graph):
    return np.array([[Liar(7.5)] * graph.n_poses] * graph.n_factors, object)


def information_matrix(graph):
    return np.array([[Other()] * graph.n_factors] * graph.n_factors, object)
