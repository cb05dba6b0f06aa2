# expect: residual=passed jacobian=error information_matrix=error others=missing; 70: floods the output, with zero bytes, escapes and bytes that are no text.
# attack: exhaustion; unlocked fails: an end without a value is no value.
import os
import sys

import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    print("\x1b]0;passed\x07\x1b[2J\x00")
    while True:
        os.write(1, b"\xff\xfe\x00\x1b[31m" * 8192)


def information_matrix(graph):
    while True:
        print("x" * 65536, file=sys.stderr)
