# expect: residual=passed jacobian=failed gauss_newton_step=failed second_step=failed others=missing; 50: returns its argument or a shared array, and changes it in later calls.
# attack: lying; unlocked fails: only float64 bytes of the exact shape count.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


SHARED = {}


def jacobian(x, graph):
    J = SHARED.setdefault((graph.n_factors, graph.n_poses), np.zeros((graph.n_factors, graph.n_poses)))
    for other in SHARED.values():
        other += 1
    return J


def gauss_newton_step(x, graph):
    for other in SHARED.values():
        other[:] = 0
    SHARED[id(x)] = x
    return x
