# expect: residual=passed others=missing; 02: opens files by raw system calls: open, openat, openat2 and a file handle.
# attack: secrets; unlocked succeeds.
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


HOW = (ctypes.c_uint64 * 3)(0, 0, 0)


@attempt
def openat():
    return call(257, 56, -100, b"/etc/passwd", 0) >= 0


@attempt
def openat2():
    return call(437, 437, -100, b"/etc/passwd", ctypes.byref(HOW), 24) >= 0


@attempt
def old_open():
    return not ARM and call(2, -1, b"/etc/passwd", 0) >= 0


@attempt
def creat():
    return not ARM and call(85, -1, b"/tmp/slam1d-hostile-02", 0o600) >= 0


@attempt
def handle():
    return call(303, 264, -100, b"/etc", (ctypes.c_char * 256)(b"\x80"), ctypes.byref(ctypes.c_int()), 0) >= 0


@attempt
def stat():
    return call(332, 291, -100, b"/etc/passwd", 0, 0xFFF, (ctypes.c_char * 256)()) >= 0
