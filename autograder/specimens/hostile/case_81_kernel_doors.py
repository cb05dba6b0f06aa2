# expect: residual=passed others=missing; 81: asks the kernel for io_uring, bpf, perf, userfaultfd, fanotify and modules.
# attack: escape; unlocked succeeds.
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


ROOM = (ctypes.c_char * 256)()


@attempt
def io_uring():
    return call(425, 425, 1, ROOM) >= 0


@attempt
def bpf():
    return call(321, 280, 0, (ctypes.c_uint32 * 18)(2, 4, 4, 1), 72) >= 0


@attempt
def perf():
    return call(298, 241, (ctypes.c_uint32 * 32)(1, 128), 0, -1, -1, 0) >= 0


@attempt
def userfaultfd():
    return call(323, 282, 0) >= 0 or call(323, 282, 1) >= 0


@attempt
def module():
    return call(313, 273, -1, b"", 0) >= 0


@attempt
def kernel_log():
    return call(103, 116, 10, 0, 0) >= 0


@attempt
def landlock():
    return call(444, 444, 0, 0, 1) >= 0


@attempt
def filter_again():
    return call(317, 277, 0, 0, 0) >= 0 or call(157, 167, 21, 0, 0, 0, 0) == 0


@attempt
def memory_secret():
    return call(447, 447, 0) >= 0
