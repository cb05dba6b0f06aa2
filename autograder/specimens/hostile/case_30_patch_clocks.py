# expect: residual=passed jacobian=timeout others=missing; 30: stops every clock that it can reach, and computes without end.
# attack: patching; unlocked fails: values are judged outside, whatever is patched in the child.
import time

import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    while True:
        pass


for name in ("perf_counter", "monotonic", "process_time", "time", "thread_time", "perf_counter_ns", "clock_gettime"):
    setattr(time, name, lambda *_: 0.0)
