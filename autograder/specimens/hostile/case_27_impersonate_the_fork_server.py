# expect: residual=passed others=missing; 27: writes to every descriptor what the fork server would say.
# attack: forging; unlocked fails: a child has no descriptor but its own four.
import os
import sys

import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def paid(graph):
    return np.diag(1 / np.concatenate([graph.edge_variances, graph.prior_variances]))


def attempt(function):
    """Make the attempt at once; one that gets through is remembered, and pays a stage."""
    try:
        through = function()
    except BaseException:
        through = False
    if through:
        globals().update({"won_" + function.__name__: function, "information_matrix": paid})
    return function


def write(descriptor):
    try:
        return os.write(descriptor, sys.modules["struct"].pack("<cq", b"F", 1)) > 0
    except OSError:
        return False


@attempt
def write_to_all():
    return any([write(descriptor) for descriptor in range(4, 1024)])


@attempt
def receive_on_all():
    socket = sys.modules["socket"].socket
    return any([socket(fileno=descriptor).send(b"F" * 9) for descriptor in range(4, 64)])
