# expect: residual=passed others=missing; 76: leaves a process behind that lives on after it.
# attack: escape; unlocked succeeds.
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


@attempt
def daemon():
    pid = os.fork()
    if pid == 0:
        os.setsid()
        if os.fork() == 0:
            sys.modules["time"].sleep(0.3)
        os._exit(0)
    return os.waitpid(pid, 0)[0] == pid


@attempt
def new_group():
    return os.setpgid(0, 0) is None


@attempt
def new_session():
    try:
        return os.setsid() is None
    except PermissionError:
        return os.getpgid(0) == os.getpid()  # the leader of a group may not
