# expect: residual=passed jacobian=failed others=missing; 29: replaces isinstance, len, print, open and type for everybody in its process.
# attack: patching; unlocked fails: values are judged outside, whatever is patched in the child.
import sys

import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    for name in ("isinstance", "issubclass", "callable"):
        setattr(builtins, name, lambda *_: True)
    builtins.print = builtins.open = builtins.repr = lambda *_, **__: "passed"
    return np.full((graph.n_factors, graph.n_poses), 7.5)


builtins = sys.modules["builtins"]
