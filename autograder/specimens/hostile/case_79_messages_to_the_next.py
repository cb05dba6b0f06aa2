# expect: residual=passed others=missing; 79: leaves messages for the next submission in shared memory, queues, semaphores and key rings.
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


KEY, CREATE, REMOVE = 0x51A1D079, 0o1600, 0


@attempt
def shared_memory():
    number = call(29, 194, KEY, 4096, CREATE)
    return number >= 0 and call(31, 195, number, REMOVE, 0) == 0


@attempt
def message_queue():
    number = call(68, 186, KEY, CREATE)
    return number >= 0 and call(71, 187, number, REMOVE, 0) == 0


@attempt
def semaphore():
    number = call(64, 190, KEY, 1, CREATE)
    return number >= 0 and call(66, 191, number, 0, REMOVE, 0) == 0


@attempt
def named_queue():
    queue = call(240, 180, b"slam1d-hostile-79", 0o102, 0o600, 0)
    return queue >= 0 and call(241, 181, b"slam1d-hostile-79") == 0


@attempt
def key():
    number = call(248, 217, b"user", b"slam1d-hostile-79", b"x", 1, -1)
    return number >= 0 and call(250, 219, 3, number, 0, 0, 0) == 0


@attempt
def key_ring():
    return call(250, 219, 1, 0, 0, 0, 0) >= 0


@attempt
def lock():
    return call(73, 32, 1, 6) == 0
