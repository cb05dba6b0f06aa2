# expect: residual=passed others=missing; 75: starts programs.
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


@attempt
def spawn():
    return os.waitpid(os.posix_spawn("/bin/true", ["true"], {}), 0)[1] == 0


@attempt
def system():
    return os.system("true") == 0


@attempt
def popen():
    return sys.modules["subprocess"].run(["true"]).returncode == 0


@attempt
def execve():
    try:
        os.execv("/nonexistent", ["nonexistent"])
    except FileNotFoundError:
        return True


@attempt
def execveat():
    return call(322, 281, -100, b"/nonexistent", 0, 0, 0) < 0 and ctypes.get_errno() == 2
