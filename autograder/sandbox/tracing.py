"""Names the system calls that the lock refuses: the filter asks the fork server instead of refusing itself.

The kernel holds a refused call back and tells the holder of the filter's listener, which notes it
and answers EPERM. A traced child is for maintenance; it is locked as any other, but its memory
can be inspected by the fork server.
"""

from __future__ import annotations

import ctypes
import errno
import fcntl
import os
import struct
import time
from pathlib import Path

PIDFD_GETFD = 438  # the same number on every architecture
_RECEIVE, _SEND = 0xC0502100, 0xC0182101  # SECCOMP_IOCTL_NOTIF_RECV, SECCOMP_IOCTL_NOTIF_SEND
_NOTICE = struct.Struct("=QIIiIQ6Q")
_ANSWER = struct.Struct("=QqiI")
_PATIENCE = 5.0  # seconds until a child has put its filter on


class Tracer:
    """The listener of one child's filter, held by the fork server."""

    def __init__(self, pid: int, listener: int) -> None:
        """Fetch the listener, which the child has as descriptor `listener`."""
        libc = ctypes.CDLL(None, use_errno=True)
        process = os.pidfd_open(pid)
        end = time.monotonic() + _PATIENCE
        try:
            while True:
                self.descriptor = libc.syscall(PIDFD_GETFD, process, listener, 0)
                if self.descriptor >= 0 and _is_listener(self.descriptor):
                    return
                if self.descriptor >= 0:
                    os.close(self.descriptor)
                elif ctypes.get_errno() != errno.EBADF:
                    raise OSError(ctypes.get_errno(), "the listener of the filter cannot be fetched")
                if time.monotonic() > end:
                    raise TimeoutError("the child did not put its filter on")
                time.sleep(0.001)
        finally:
            os.close(process)

    def answer(self) -> int | None:
        """Refuse the call that waits and give its number; None where the child has ended."""
        notice = bytearray(_NOTICE.size)
        try:
            fcntl.ioctl(self.descriptor, _RECEIVE, notice)
            identity, _, _, number, *_ = _NOTICE.unpack(notice)
            fcntl.ioctl(self.descriptor, _SEND, bytearray(_ANSWER.pack(identity, 0, -errno.EPERM, 0)))
        except OSError:
            return None
        return int(number)

    def close(self) -> None:
        """Let go of the listener."""
        os.close(self.descriptor)


def _is_listener(descriptor: int) -> bool:
    return str(Path(f"/proc/self/fd/{descriptor}").readlink()) == "anon_inode:seccomp notify"
