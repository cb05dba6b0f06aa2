"""Standard streams that decide no outcome: closed, full or odd, what is printed may be lost, the work is not.

A stream that cannot be written is exchanged for the null device, once, and the command goes on.
"""

from __future__ import annotations

import errno
import io
import os
import select
import sys
import warnings
from typing import Any


class _Lenient(io.FileIO):
    """A descriptor for output whose errors end the output, not the program."""

    def write(self, data: Any) -> int:
        """Write, or throw away what nobody can take."""
        try:
            written = super().write(data)
            while written is None:  # somebody who shares the stream has made it non-blocking
                select.select([], [self], [])
                written = super().write(data)
        except OSError as error:
            _to_nowhere(self.fileno())
            if self.fileno() == 1 and error.errno != errno.EPIPE:  # a reader that has left wants no more
                sys.stderr.write(f"autograder: What goes to stdout is lost ({error.strerror}); the work goes on.\n")
            return memoryview(data).nbytes
        return written


def make_safe() -> None:
    """Make the three standard streams usable, whatever they are; leave alone those that a program has put there.

    Warnings of libraries are for those who write programs, not for those who read marks: they are not
    shown, unless Python was asked for them.
    """
    if not sys.warnoptions:
        warnings.simplefilter("ignore")
    for descriptor in range(3):  # the lowest first, so that each gets its own number
        try:
            os.fstat(descriptor)
        except OSError:
            _to_nowhere(descriptor)
    if sys.stdin is None:
        sys.stdin = open(0, encoding="utf-8", closefd=False)  # noqa: SIM115  # for as long as the program runs
    sys.stdout, sys.stderr = _opened(1, sys.stdout), _opened(2, sys.stderr)


def are_ours() -> bool:
    """Say whether the streams are those that the program was started with: a test or a notebook has its own."""
    return sys.stdout is sys.__stdout__ and sys.stderr is sys.__stderr__


def _opened(descriptor: int, before: Any) -> io.TextIOWrapper:
    """Open a stream again: what its encoding cannot express is escaped."""
    if before is not None:
        before.flush()
    raw = _Lenient(descriptor, "w", closefd=False)
    return io.TextIOWrapper(
        io.BufferedWriter(raw),
        encoding=getattr(before, "encoding", "utf-8"),
        errors="backslashreplace",
        line_buffering=descriptor == 2 or raw.isatty(),
        write_through=bool(getattr(before, "write_through", False)),
    )


def _to_nowhere(descriptor: int) -> None:
    nowhere = os.open(os.devnull, os.O_RDWR)
    if nowhere != descriptor:
        os.dup2(nowhere, descriptor)
        os.close(nowhere)
