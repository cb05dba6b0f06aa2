# expect: residual=passed jacobian=failed information_matrix=failed others=missing; 09: searches its memory for J, Omega and f of the exam's other cases that fit the graph in hand.
# attack: secrets; unlocked fails: no case gives another stage away.
import sys

import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def everything():
    """Give all arrays that this process can reach: from its frames, its modules, and the collector."""
    frame, seen, found = sys._getframe(1), set(), []
    queue = [value for module in list(sys.modules.values()) for value in list(getattr(module, "__dict__", {}).values())]
    queue += sys.modules["gc"].get_objects()
    while frame is not None:
        queue += frame.f_locals.values()
        frame = frame.f_back
    names = ("_plans", "_objects", "cases", "plan")
    while queue:
        value = queue.pop()
        if id(value) in seen:
            continue
        seen.add(id(value))
        if type(value) is np.ndarray:
            found.append(value)
        elif type(value) in (list, tuple) and len(seen) < 200_000:
            queue += value
        else:
            queue += [getattr(value, name) for name in names if hasattr(type(value), "__dict__") and name in getattr(value, "__dict__", ())]
    return found


ARRAYS = []


def candidates(shape):
    if not ARRAYS:
        ARRAYS.extend(everything())
    return [array for array in ARRAYS if array.shape == shape]


def jacobian(x, graph):
    J0 = np.full((graph.n_factors, graph.n_poses), 7.5)
    f0 = residual(np.zeros(graph.n_poses), graph)
    step = residual(np.ones(graph.n_poses), graph) - f0
    for J in candidates(J0.shape):
        if np.isfinite(J).all() and np.allclose(J.sum(axis=1), step) and np.allclose(J @ x + f0, residual(x, graph)):
            return J
    return J0


def information_matrix(graph):
    weights = 1 / np.concatenate([graph.edge_variances, graph.prior_variances])
    for omega in candidates((graph.n_factors, graph.n_factors)):
        if np.allclose(np.diag(omega), weights):
            return omega
    return np.full((graph.n_factors, graph.n_factors), 7.5)
