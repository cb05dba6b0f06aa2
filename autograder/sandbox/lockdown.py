"""Takes from a process, for good, everything that a submission has no business with.

Direct calls of the C library through ctypes: no_new_privs, Landlock, resource limits and the
system call filter of `seccomp`. Importing this file does nothing and works on every system.
"""

from __future__ import annotations

import ctypes
import errno
import fcntl
import os
import signal
import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from . import seccomp

_PR_SET_PDEATHSIG, _PR_GET_SECCOMP, _PR_SET_DUMPABLE = 1, 21, 4
_PR_SET_SECCOMP, _PR_SET_NO_NEW_PRIVS = 22, 38
_MODE_FILTER = 2
_LANDLOCK_CREATE, _LANDLOCK_RESTRICT = 444, 446  # the same number on every architecture
_LANDLOCK_VERSION = 1
_OUT_OF_THE_WAY = 10  # lower descriptors are given to the child's own channels
_ABOVE_ALL = 1024  # the fork server has a dozen low descriptors; an old kernel closes up to here one by one
# What each Landlock ABI added: the file rights known to it, TCP, and the scopes (signals, abstract sockets).
_FILE_RIGHTS = {1: 13, 2: 14, 3: 15, 4: 15, 5: 16}
_NET_RIGHTS, _NET_ABI = 0b11, 4
_SCOPES, _SCOPE_ABI = 0b11, 6
_CAP_VERSION_3 = 0x20080522
_CAPSET = {"x86_64": 126, "aarch64": 91}
_SECCOMP = {"x86_64": 317, "aarch64": 277}
_SET_MODE_FILTER, _NEW_LISTENER = 1, 8


class _Program(ctypes.Structure):
    _fields_ = (("length", ctypes.c_ushort), ("instructions", ctypes.c_void_p))


class _Ruleset(ctypes.Structure):
    _fields_ = (("files", ctypes.c_uint64), ("net", ctypes.c_uint64), ("scopes", ctypes.c_uint64))


@dataclass
class Lock:
    """A lock made ready in the fork server, so that a child needs a few system calls to close it.

    `seccomp` and `landlock` hold the reason where that part is not available, and are empty where
    it is.
    """

    memory: int  # bytes above the size that the fork server has
    cpu_seconds: int
    without: frozenset[str] = frozenset()
    trace: bool = False  # let the fork server refuse, so that it can say what was refused
    seccomp: str = ""
    landlock: str = ""
    abi: int = 0
    base: int = 0
    _libc: Any = field(default=None, repr=False)
    _program: Any = field(default=None, repr=False)
    _instructions: Any = field(default=None, repr=False)
    _ruleset: int = -1

    def prepare(self) -> None:
        """Find out what this machine has, drop privileges, and build what children will use."""
        self.base = _address_space()
        if sys.platform != "linux":
            self.seccomp = self.landlock = f"not available on {sys.platform}"
            return
        self._libc = ctypes.CDLL(None, use_errno=True)
        _drop_capabilities(self._libc)
        if not self.trace:
            self._libc.prctl(_PR_SET_DUMPABLE, 0, 0, 0, 0)
        self.seccomp = self._prepare_seccomp()
        self.landlock = self._prepare_landlock()

    def _prepare_seccomp(self) -> str:
        if "seccomp" in self.without:
            return "switched off"
        machine = os.uname().machine
        if machine not in seccomp.ARCHITECTURES or sys.maxsize < 2**32 or sys.byteorder != "little":
            return f"no table of system calls for {machine}"
        if self._libc.prctl(_PR_GET_SECCOMP, 0, 0, 0, 0) < 0:
            return f"refused by the kernel ({os.strerror(ctypes.get_errno())})"
        otherwise = seccomp.RET_USER_NOTIF if self.trace else seccomp.RET_REFUSE
        code = seccomp.program(seccomp.ARCHITECTURES[machine], otherwise)
        self._instructions = ctypes.create_string_buffer(seccomp.encode(code))
        self._program = _Program(len(code), ctypes.addressof(self._instructions))
        return "" if self.trace else _tried(self._filter)

    def _prepare_landlock(self) -> str:
        if "landlock" in self.without:
            return "switched off"
        self.abi = self._libc.syscall(_LANDLOCK_CREATE, None, ctypes.c_size_t(0), _LANDLOCK_VERSION)
        if self.abi < 1:
            number, self.abi = ctypes.get_errno(), 0
            return {
                errno.ENOSYS: "the kernel does not have it",
                errno.EOPNOTSUPP: "switched off in the kernel",
            }.get(number, os.strerror(number))
        rights = (1 << _FILE_RIGHTS.get(self.abi, _FILE_RIGHTS[5])) - 1
        net = _NET_RIGHTS if self.abi >= _NET_ABI else 0
        scopes = _SCOPES if self.abi >= _SCOPE_ABI else 0
        size = 24 if self.abi >= _SCOPE_ABI else 16 if self.abi >= _NET_ABI else 8
        ruleset = _Ruleset(rights, net, scopes)
        descriptor = self._libc.syscall(_LANDLOCK_CREATE, ctypes.byref(ruleset), ctypes.c_size_t(size), 0)
        if descriptor < 0:
            return os.strerror(ctypes.get_errno())
        self._ruleset = fcntl.fcntl(descriptor, fcntl.F_DUPFD_CLOEXEC, _OUT_OF_THE_WAY)
        os.close(descriptor)
        return _tried(self._fence)

    def tie(self, parent: int) -> None:
        """Have the kernel kill this process when its parent ends; end at once where it already has."""
        if self._libc is not None:
            self._libc.prctl(_PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0)
        if os.getppid() != parent:
            os._exit(0)

    def close(self, keep: int) -> None:
        """Lock the calling process; descriptors from `keep` on are closed. Raises OSError where a part fails."""
        if self._libc is not None:
            self._keep_privileges_out()
            if not self.landlock:
                self._fence()
        os.closerange(keep, _ABOVE_ALL)
        if "rlimits" not in self.without:
            self._limit()
        if self._libc is not None and not self.seccomp and self.trace:
            number = _SECCOMP[os.uname().machine]
            listener = self._libc.syscall(number, _SET_MODE_FILTER, _NEW_LISTENER, ctypes.byref(self._program))
            self._call("seccomp", 0 if listener == keep else -1)
        elif self._libc is not None and not self.seccomp:
            self._filter()

    def _keep_privileges_out(self) -> None:
        self._call("PR_SET_NO_NEW_PRIVS", self._libc.prctl(_PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0))

    def _fence(self) -> None:
        self._keep_privileges_out()
        self._call("landlock_restrict_self", self._libc.syscall(_LANDLOCK_RESTRICT, self._ruleset, 0))

    def _filter(self) -> None:
        self._keep_privileges_out()
        result = self._libc.prctl(_PR_SET_SECCOMP, _MODE_FILTER, ctypes.byref(self._program), 0, 0)
        self._call("PR_SET_SECCOMP", result)

    def _call(self, name: str, result: int) -> None:
        if result != 0:
            number = ctypes.get_errno()
            raise OSError(number, f"{name}: {os.strerror(number)}")

    def _limit(self) -> None:
        import resource  # noqa: PLC0415  # not on every system; loaded once, by the fork server's warm-up

        limits = {
            "RLIMIT_CPU": self.cpu_seconds,
            "RLIMIT_FSIZE": 0,
            "RLIMIT_CORE": 0,
            "RLIMIT_NPROC": 0,
            "RLIMIT_NOFILE": 16,
            "RLIMIT_MEMLOCK": 0,
            "RLIMIT_MSGQUEUE": 0,
        }
        if self.base:
            limits["RLIMIT_AS"] = self.base + self.memory
        for name, most in limits.items():
            number = getattr(resource, name, None)
            if number is not None:
                resource.setrlimit(number, (most, most))


def _address_space() -> int:
    try:
        with open("/proc/self/statm", "rb") as file:
            return int(file.read().split()[0]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, ValueError):
        return 0  # no such file on this system: memory is not limited there


def _drop_capabilities(libc: Any) -> None:
    """Give up the powers of root, where there are any; children inherit that."""
    number = _CAPSET.get(os.uname().machine)
    if number is not None:
        header = (ctypes.c_uint32 * 2)(_CAP_VERSION_3, 0)
        libc.syscall(number, header, (ctypes.c_uint32 * 6)())  # a failure leaves what the filter refuses anyway


def _tried(lock: Callable[[], None]) -> str:
    """Close a part of the lock in a process made for it; return why it cannot be closed, "" where it can.

    A kernel, or the container around this, may let a process ask for a lock and then not let it close one.
    """
    pid = os.fork()
    if pid == 0:
        number = errno.EIO
        try:
            lock()
            number = 0
        except OSError as error:
            number = error.errno or errno.EIO
        finally:
            os._exit(number if number < 256 else errno.EIO)
    _, status = os.waitpid(pid, 0)
    if not os.WIFEXITED(status):
        return f"tried, and ended by signal {os.WTERMSIG(status)}"
    code = os.WEXITSTATUS(status)
    return f"tried, and refused by the kernel ({os.strerror(code)})" if code else ""
