# expect: residual=passed others=missing; 72: writes to /dev/full and reads from /dev/zero without end.
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
def full():
    return os.open("/dev/full", os.O_WRONLY) >= 0


@attempt
def zero():
    return os.open("/dev/zero", os.O_RDONLY) >= 0


@attempt
def random():
    return os.open("/dev/random", os.O_RDONLY) >= 0


@attempt
def terminal():
    return call(16, 29, 1, 0x5413, (ctypes.c_char * 64)()) >= 0 or os.open("/dev/ptmx", os.O_RDWR) >= 0
