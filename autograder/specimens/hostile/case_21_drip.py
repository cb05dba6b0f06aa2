# expect: residual=passed jacobian=timeout others=missing; 21: announces a small frame and sends a byte of it every 50 ms.
# attack: forging; unlocked fails: the channel is checked by the grader, whatever is locked.
import os
import time

import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    os.write(3, (1000).to_bytes(4, "little"))
    while True:
        os.write(3, b"\x90")
        time.sleep(0.05)
