# expect: residual=passed others=missing; 78: leaves files, folders and links in /tmp, /dev/shm and the home, and changes others.
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


NAME = "/slam1d-hostile-78"


def leave(folder):
    return os.open(folder + NAME, os.O_WRONLY | os.O_CREAT, 0o600) >= 0


@attempt
def tmp():
    return leave("/tmp")


@attempt
def shared_memory():
    return leave("/dev/shm")


@attempt
def home():
    return leave(os.path.expanduser("~"))


@attempt
def nameless():
    return os.open("/tmp", os.O_TMPFILE | os.O_RDWR) >= 0


@attempt
def folder():
    return os.mkdir("/tmp" + NAME + "-folder") is None


@attempt
def link():
    return os.symlink("/etc/passwd", "/tmp" + NAME + "-link") is None


@attempt
def hard_link():
    return os.link("/tmp" + NAME, "/tmp" + NAME + "-hard") is None


@attempt
def pipe():
    return os.mkfifo("/tmp" + NAME + "-pipe") is None


@attempt
def rename():
    return os.rename("/tmp" + NAME, "/tmp" + NAME + "-renamed") is None


@attempt
def unlink():
    return os.unlink("/tmp" + NAME + "-link") is None


@attempt
def mode():
    return os.chmod("/tmp" + NAME + "-renamed", 0o777) is None


@attempt
def times():
    return os.utime("/tmp" + NAME + "-renamed") is None


@attempt
def truncate():
    return os.truncate("/tmp" + NAME + "-renamed", 1 << 20) is None


@attempt
def change_folder():
    return os.chdir("/tmp") is None


@attempt
def mask():
    return os.umask(0) >= 0


@attempt
def attribute():
    return os.setxattr("/tmp" + NAME + "-renamed", "user.slam1d", b"x") is None


@attempt
def sync():
    return call(306, 267, 1) >= 0
