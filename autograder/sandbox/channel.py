"""The grader's end of one child: sends a request, waits for its frames, never longer than the limits say."""

from __future__ import annotations

import os
import select
import socket
import time
from dataclasses import dataclass
from typing import Literal

import msgspec

from autograder.sandbox import frames

WALL_FACTOR = 3.0  # seconds that may pass for every second of computing that is allowed
_CHUNK = 1 << 18
_SHORTEST_WAIT = 0.001

Reason = Literal["timeout", "memory", "died", "output", "violation", "budget"]


class Ended(Exception):  # noqa: N818  # an outcome of a run, caught by the session
    """The child cannot be used any more.

    `sure` is False where it ran out of time by the clock alone: a busy machine may be to blame.
    """

    def __init__(self, reason: Reason, *, sure: bool = True) -> None:
        super().__init__(reason)
        self.reason: Reason = reason
        self.sure = sure


@dataclass
class Budget:
    """What a submission may still use, over all of its children: seconds of computing and of waiting."""

    cpu: float
    wall: float


class Channel:
    """One child: its data socket, the pipe of its output, its clock.

    Parameters
    ----------
    data : socket
        The data channel; made non-blocking.
    output : int
        The reading end of the child's output; made non-blocking, closed with the channel.
    output_bytes : int
        How much the child may print.
    budget : Budget
        What is left for the submission; every wait takes from it.
    """

    def __init__(self, data: socket.socket, output: int, output_bytes: int, budget: Budget) -> None:
        data.setblocking(False)
        os.set_blocking(output, False)
        self._data = data
        self._output = output
        self._output_left = output_bytes
        self._budget = budget
        self._received = bytearray()
        self._unsent = memoryview(b"")
        self._nonce = 0
        self._clock = 0
        self._poll = select.poll()
        self._poll.register(output, select.POLLIN)
        self._poll.register(data, select.POLLIN)

    def watch(self, pid: int) -> None:
        """Name the process whose computing time counts."""
        self._clock = (~pid << 3) | 2  # as clock_getcpuclockid of the C library makes it of a process id

    def close(self) -> None:
        """Close both descriptors."""
        self._data.close()
        os.close(self._output)

    def begin(self, message: bytes, nonce: int) -> None:
        """Start to send a request."""
        self._nonce = nonce
        self._unsent = memoryview(message)
        self._send()

    def require_silence(self) -> None:
        """Raise Ended where there are bytes that belong to no reply."""
        if not self._received:
            self._receive()
        if self._received:
            raise Ended("violation")

    def reply(self, bound: int, cpu_seconds: float, nonce: int | None = None) -> frames.Reply:
        """Wait for one frame of at most `bound` bytes that repeats the nonce of the request.

        Raises
        ------
        Ended
            Where the child dies, floods, breaks the protocol, computes for more than
            `cpu_seconds`, takes longer than three times that, or the budget is used up.
        """
        cpu, wall = self._cpu(), time.monotonic()
        begun = (cpu, wall)
        try:
            while True:
                frame = self._frame(bound)
                if frame is not None:
                    if frame.nonce != (self._nonce if nonce is None else nonce):
                        raise Ended("violation")
                    return frame
                self._wait(self._left(cpu_seconds, cpu - begun[0], wall - begun[1]))
                self._send()
                self._receive()
                cpu, wall = self._cpu(), time.monotonic()
        finally:
            self._budget.cpu -= self._cpu() - begun[0]
            self._budget.wall -= time.monotonic() - begun[1]

    def _left(self, cpu_seconds: float, cpu: float, wall: float) -> float:
        budget = min(self._budget.cpu - cpu, self._budget.wall - wall)
        if budget <= 0:
            raise Ended("budget", sure=self._budget.cpu <= cpu)
        left = min(cpu_seconds - cpu, WALL_FACTOR * cpu_seconds - wall)
        if left <= 0:
            raise Ended("timeout", sure=cpu_seconds <= cpu)
        return max(_SHORTEST_WAIT, min(left, budget))

    def _cpu(self) -> float:
        try:
            return time.clock_gettime(self._clock) if self._clock else 0.0
        except OSError:  # a system without clocks of other processes: there the wall alone limits
            return 0.0

    def _wait(self, seconds: float) -> None:
        self._poll.modify(self._data, select.POLLIN | (select.POLLOUT if self._unsent else 0))
        for descriptor, _ in self._poll.poll(1000 * seconds):
            if descriptor == self._output:
                self._drain()

    def _drain(self) -> None:
        try:
            count = len(os.read(self._output, _CHUNK))
        except BlockingIOError:
            return
        if count == 0:  # the child closed it; its death is seen on the data channel
            self._poll.unregister(self._output)
        self._output_left -= count
        if self._output_left < 0:
            raise Ended("output")

    def _send(self) -> None:
        try:
            while self._unsent:
                self._unsent = self._unsent[self._data.send(self._unsent) :]
        except BlockingIOError:
            return
        except OSError as error:
            raise Ended("died") from error

    def _receive(self) -> None:
        try:
            part = self._data.recv(_CHUNK)
        except BlockingIOError:
            return
        except OSError as error:
            raise Ended("died") from error
        if not part:
            raise Ended("died")
        self._received += part

    def _frame(self, bound: int) -> frames.Reply | None:
        """Take one whole frame from what was received; nothing beyond the bound is ever awaited."""
        received, header = self._received, frames.HEADER.size
        if len(received) < header:
            return None
        (length,) = frames.HEADER.unpack_from(received)
        if length > bound:
            raise Ended("violation")
        if len(received) < header + length:
            return None
        try:
            with memoryview(received) as view:
                frame = frames.reply_decoder.decode(view[header : header + length])
        except (msgspec.MsgspecError, ValueError, OverflowError, RecursionError) as error:
            raise Ended("violation") from error
        del received[: header + length]
        return frame
