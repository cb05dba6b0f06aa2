# expect: residual=passed jacobian=error others=missing; 32: replaces methods of the harness and writes its own outcome into its frames.
# attack: patching; unlocked fails: values are judged outside, whatever is patched in the child.
import sys

import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    frame = sys._getframe(1)
    gathered = frame.f_locals["self"]
    gathered.outcome[:] = bytes(len(gathered.outcome))
    type(gathered)._refuse = lambda *_: None
    type(gathered)._take = lambda *_: None
    raise ValueError("nobody hears this")
