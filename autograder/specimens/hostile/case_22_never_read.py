# expect: residual=timeout others=missing; 22: stops reading the channel once it is loaded.
# attack: forging; unlocked fails: the channel is checked by the grader, whatever is locked.
import sys
import time

import numpy as np


def residual(x, graph):
    return np.zeros(graph.n_factors)


def wait(count):
    while True:
        time.sleep(1)


sys.modules["sandbox.child"]._read = wait
