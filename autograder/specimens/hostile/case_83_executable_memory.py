# expect: residual=passed others=missing; 83: makes memory executable and runs its own machine code there.
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


libc.mmap.restype = ctypes.c_void_p
CODE = b"\xc0\x03\x5f\xd6" if ARM else b"\xc3"  # return


def run(address):
    ctypes.memmove(address, CODE, len(CODE))
    ctypes.CFUNCTYPE(None)(address)()
    return True


@attempt
def mmap():
    address = libc.mmap(None, ctypes.c_size_t(4096), 7, 0x22, -1, ctypes.c_long(0))
    return address != ctypes.c_void_p(-1).value and run(address)


@attempt
def mprotect():
    address = libc.mmap(None, ctypes.c_size_t(4096), 3, 0x22, -1, ctypes.c_long(0))
    return libc.mprotect(ctypes.c_void_p(address), ctypes.c_size_t(4096), 7) == 0 and run(address)


@attempt
def protection_key():
    address = libc.mmap(None, ctypes.c_size_t(4096), 3, 0x22, -1, ctypes.c_long(0))
    return call(329, 288, ctypes.c_void_p(address), 4096, 7, -1) == 0 and run(address)


@attempt
def personality():
    return call(135, 92, 0x0400000) >= 0


@attempt
def from_a_file():
    return libc.mmap(None, ctypes.c_size_t(4096), 5, 2, 1, ctypes.c_long(0)) != ctypes.c_void_p(-1).value


@attempt
def over_its_own_code():
    at = ctypes.cast(libc.getpid, ctypes.c_void_p).value & ~4095
    return libc.mprotect(ctypes.c_void_p(at), ctypes.c_size_t(4096), 7) == 0
