# expect: residual=passed jacobian=error information_matrix=failed others=missing; 31: replaces in the harness what turns values into bytes.
# attack: patching; unlocked fails: values are judged outside, whatever is patched in the child.
import sys

import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def flat(*_):
    return (), b"", sys.modules["sandbox.frames"].Kind.FLOAT_ARRAY


def jacobian(x, graph):
    return "right"


def information_matrix(graph):
    return np.full((graph.n_factors, graph.n_factors), 7.5)


for module in ("sandbox.batches", "sandbox.values", "sandbox.submission"):
    sys.modules[module].flatten = flat
np.asarray = np.array = lambda *_, **__: "right"
