# expect: residual=passed others=missing; 71: takes all descriptors there are.
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


@attempt
def dup():
    return len([os.dup(1) for _ in range(8)]) == 8


@attempt
def pipe():
    return len(os.pipe()) == 2


@attempt
def duplicate_over():
    return os.dup2(1, 900) == 900


@attempt
def event():
    return os.eventfd(0) >= 0


@attempt
def memory_file():
    return os.memfd_create("slam1d-hostile-71") >= 0


@attempt
def epoll():
    return call(291, 20, 0) >= 0


@attempt
def timer():
    return call(283, 85, 1, 0) >= 0


@attempt
def fcntl():
    return call(72, 25, 1, 0, 9) >= 0


@attempt
def inotify():
    return call(294, 26, 0) >= 0
