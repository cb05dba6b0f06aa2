# expect: residual=passed jacobian=failed information_matrix=failed others=missing remark=changes_input; 102: makes the arrays of the graphs writable and changes them for all later calls.
# attack: patching; unlocked fails: values are judged outside, whatever is patched in the child.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    for name in ("edges", "measurements", "edge_variances", "priors", "prior_means", "prior_variances"):
        values = getattr(graph, name)
        values = values if values.base is None or type(values.base) is bytes else values.base
        try:
            values.flags.writeable = True
        except ValueError:
            pass
        object.__setattr__(graph, name, np.zeros_like(getattr(graph, name)))
    object.__setattr__(graph, "n_poses", 1)
    x[:] = 0
    return np.zeros((graph.n_factors, graph.n_poses))


def information_matrix(graph):
    return np.zeros((graph.n_factors, graph.n_factors))
