# expect: residual=passed information_matrix=failed gauss_newton_step=failed second_step=failed others=missing; 53: answers rightly only when it is asked a second time.
# attack: lying; unlocked fails: only float64 bytes of the exact shape count.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


SEEN = set()


def again(*what):
    """Tell whether this was asked before."""
    return what in SEEN or SEEN.add(what) is not None


def information_matrix(graph):
    right = np.diag(1 / np.concatenate([graph.edge_variances, graph.prior_variances]))
    return right if again("omega", graph) else right + 1


def gauss_newton_step(x, graph):
    return np.zeros(graph.n_poses) if again("step", graph) else -x
