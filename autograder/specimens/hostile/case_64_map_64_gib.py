# expect: residual=passed others=missing; 64: maps 64 GiB of address space by a raw call.
# attack: exhaustion; unlocked succeeds.
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


libc.mmap.restype = ctypes.c_void_p
PRIVATE, ANONYMOUS, NO_RESERVE = 0x02, 0x20, 0x4000


def mapped(flags, size=64 << 30):
    address = libc.mmap(None, ctypes.c_size_t(size), 3, flags, -1, ctypes.c_long(0))
    return address not in (None, ctypes.c_void_p(-1).value)


@attempt
def mmap():
    return mapped(PRIVATE | ANONYMOUS | NO_RESERVE)


@attempt
def shared():
    return mapped(0x01 | ANONYMOUS | NO_RESERVE)


@attempt
def grow():
    small = libc.mmap(None, ctypes.c_size_t(4096), 3, PRIVATE | ANONYMOUS, -1, ctypes.c_long(0))
    return call(25, 216, ctypes.c_void_p(small), 4096, 64 << 30, 1) > 0
