# expect: residual=passed others=missing; 77: signals the fork server, the grader, its group, and everybody.
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


WINDOW_CHANGE = 28  # a signal that is ignored where nobody asked for it


@attempt
def parent():
    return os.kill(ancestors()[0], WINDOW_CHANGE) is None


@attempt
def grader():
    return os.kill(ancestors()[1], WINDOW_CHANGE) is None


@attempt
def group():
    return os.killpg(0, WINDOW_CHANGE) is None


@attempt
def everybody():
    return os.kill(-1, 0) is None


@attempt
def itself():
    return os.kill(os.getpid(), WINDOW_CHANGE) is None


@attempt
def thread():
    return call(234, 131, ancestors()[0], ancestors()[0], WINDOW_CHANGE) == 0


@attempt
def queue():
    return call(424, 424, call(434, 434, ancestors()[0], 0), WINDOW_CHANGE, 0, 0) == 0
