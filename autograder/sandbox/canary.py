"""What a locked child must not be able to do, tried in earnest at every start of a fork server."""

from __future__ import annotations

import ctypes
import errno
import mmap
import os
import socket
import sys
from collections.abc import Callable

_REFUSED = (errno.EPERM, errno.EACCES)
_EXECUTABLE = 7  # PROT_READ | PROT_WRITE | PROT_EXEC


def attempts() -> list[str]:
    """Try every escape and name those that succeed."""
    return [name for name, attempt in _ATTEMPTS.items() if _succeeds(attempt)]


def _succeeds(attempt: Callable[[], object]) -> bool:
    """Tell whether an attempt was not refused; an error other than a refusal means it got through."""
    try:
        attempt()
    except OSError as error:
        return error.errno not in _REFUSED
    except BaseException:  # noqa: BLE001  # a canary that cannot tell has not shown that the lock holds
        return True
    return True


def _open() -> None:
    os.close(os.open("/dev/null", os.O_RDONLY))


def _write_file() -> None:
    os.close(os.open("/dev/null", os.O_WRONLY))


def _list() -> None:
    os.listdir("/")  # noqa: PTH208  # the system call, and no more around it than needed


def _connect() -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as end:
        end.settimeout(0.2)
        end.connect(("127.0.0.1", 1))  # an error that says "nobody listens" is no refusal


def _send_datagram() -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as end:
        end.connect(("127.0.0.1", 1))


def _local_socket() -> None:
    for end in socket.socketpair():
        end.close()


def _fork() -> None:
    if os.fork() == 0:
        os._exit(0)


def _execute() -> None:
    os.execv("/nonexistent", ["nonexistent"])


def _signal() -> None:
    os.kill(os.getppid(), 0)


def _map_executable() -> None:
    libc = ctypes.CDLL(None, use_errno=True)
    libc.mmap.restype = ctypes.c_void_p
    flags = mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS
    address = libc.mmap(None, ctypes.c_size_t(4096), _EXECUTABLE, flags, -1, ctypes.c_long(0))
    if address == ctypes.c_void_p(-1).value:
        raise OSError(ctypes.get_errno(), "mmap")


def _make_executable() -> None:
    libc = ctypes.CDLL(None, use_errno=True)
    pages = mmap.mmap(-1, 4096, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)
    address = ctypes.addressof(ctypes.c_char.from_buffer(pages))
    if libc.mprotect(ctypes.c_void_p(address), ctypes.c_size_t(4096), _EXECUTABLE) != 0:
        raise OSError(ctypes.get_errno(), "mprotect")


_ATTEMPTS: dict[str, Callable[[], object]] = {
    "open a file": _open,
    "open a file for writing": _write_file,
    "list a directory": _list,
    "connect to a TCP port": _connect,
    "send a datagram": _send_datagram,
    "make a local socket": _local_socket,
    "fork": _fork,
    "execute a program": _execute,
    "signal its parent": _signal,
    "map executable memory": _map_executable,
    "make memory executable": _make_executable,
}
if sys.platform != "linux":  # nothing is refused there, and nothing claims to be
    _ATTEMPTS = {}
