# expect: residual=passed others=missing; 80: puts links where the grader may write next.
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


NAMES = ("results", "run.json", "case_80_links_in_the_way.json", ".run.json.1.part", "feedback")


def link(folder):
    return any([os.symlink("/etc/passwd", f"{folder}/slam1d-hostile-80-{name}") is None for name in NAMES])


@attempt
def in_tmp():
    return link("/tmp")


@attempt
def here():
    return link(".")


@attempt
def by_raw_call():
    return call(266, 36, b"/etc/passwd", -100, b"/tmp/slam1d-hostile-80-raw") == 0
