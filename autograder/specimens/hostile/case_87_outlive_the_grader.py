# expect: residual=passed others=missing; 87: waits while it is loaded, so that the grader can be killed while it lives.
# attack: escape; unlocked fails: the kernel ends a child with its parent, and a test kills the grader meanwhile.
import time

import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


while True:
    time.sleep(1)
