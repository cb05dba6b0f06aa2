# expect: residual=passed others=missing; 61: starts processes, a few dozen of them.
# attack: exhaustion; unlocked succeeds.
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


ctypes = sys.modules["ctypes"]  # not allowed, but in memory: the worst case
libc = ctypes.CDLL(None, use_errno=True)
libc.syscall.restype = ctypes.c_long
ARM = "aarch64" in getattr(sys.implementation, "_multiarch", "")


def call(x86_64, aarch64, *arguments):
    """Make a system call by its number."""
    arguments = [one if not isinstance(one, int) else ctypes.c_long(one) for one in arguments]
    return libc.syscall(ctypes.c_long(aarch64 if ARM else x86_64), *arguments)


def many(start):
    for _ in range(30):
        pid = start()
        if pid == 0:
            os._exit(0)
        os.waitpid(pid, 0)
    return True


@attempt
def fork():
    return many(os.fork)


@attempt
def clone():
    pid = call(56, 220, 17, 0, 0, 0, 0)
    if pid == 0:
        os._exit(0)
    return pid > 0


@attempt
def clone3():
    pid = call(435, 435, (ctypes.c_uint64 * 8)(0, 0, 0, 0, 17, 0, 0, 0), 64)
    if pid == 0:
        os._exit(0)
    return pid > 0
