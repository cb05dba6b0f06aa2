"""Starts the fork server and speaks with it; every kill and every reaping of a child goes through it."""

from __future__ import annotations

import importlib.util
import math
import os
import signal
import socket
import struct
import subprocess
import sys
from collections.abc import Collection
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import msgspec

from autograder.errors import SandboxError, SandboxLost
from autograder.sandbox import forkserver, frames
from autograder.sandbox.channel import WALL_FACTOR, Budget, Channel
from autograder.sandbox.kernel import ONE_THREAD, kernel_settings

_FOLDER = Path(__file__).resolve().parent
_POSEGRAPH = _FOLDER.parent.parent / "assignment" / "posegraph.py"
_START_SECONDS, _REPLY_SECONDS = 60.0, 30.0


@dataclass(frozen=True)
class Limits:
    """What one submission may use.

    Parameters
    ----------
    cpu_seconds : float
        Computing time of one batch, and of one statement while loading [s]; three times that may pass.
    memory_mib : int
        Memory above that of the fork server [MiB].
    output_bytes : int
        What a child may print; nothing of it is kept.
    """

    cpu_seconds: float = 2.0
    memory_mib: int = 512
    output_bytes: int = 16 << 20

    @property
    def total_cpu(self) -> float:
        """Computing time of a submission as a whole [s]."""
        return 4 * self.cpu_seconds

    def budget(self) -> Budget:
        """Return what a submission may use as a whole."""
        return Budget(self.total_cpu, WALL_FACTOR * self.total_cpu)


@dataclass(frozen=True)
class Confinement:
    """How well a submission is locked in on this machine."""

    level: Literal["full", "seccomp", "none"]
    detail: str

    @property
    def wording(self) -> str:
        """The level and what it means, as it stands in every report."""
        return f"{self.level}: {self.detail}"


def confinement_of(ready: frames.Ready) -> Confinement:
    """Name the level of what a fork server has."""
    if ready.seccomp:
        detail = f"NOT CONFINED: time-outs only. Grade only code you trust. (seccomp: {ready.seccomp})"
        return Confinement("none", detail)
    if ready.landlock:
        return Confinement("seccomp", f"Landlock unavailable ({ready.landlock})")
    scope = ", ".join(["files", *(["TCP"] if ready.abi >= 4 else []), *(["signals"] if ready.abi >= 6 else [])])
    return Confinement("full", f"seccomp + Landlock ABI {ready.abi} ({scope})")


class Server:
    """The fork server's process and the control channel to it.

    The process starts at once, and loads what submissions may use while its inputs are still being made.
    """

    ready: frames.Ready

    def __init__(self) -> None:
        if sys.platform == "win32":
            raise SandboxError("Windows has no fork: grade in WSL2 or in a Linux container.")
        self._control, theirs = socket.socketpair()
        with theirs:
            self._process = subprocess.Popen(
                [
                    sys.executable,
                    # like -I, but the hash seed of the environment counts: sets must have one order in every run
                    *("-s", "-P", "-S", "-B"),
                    str(_FOLDER / "forkserver.py"),
                    str(theirs.fileno()),
                    str(os.getpid()),
                    *_library_paths(),
                ],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.PIPE,
                cwd="/",
                env={"PYTHONHASHSEED": "0", "LC_ALL": "C.UTF-8", **kernel_settings(os.environ), **ONE_THREAD},
                pass_fds=[theirs.fileno()],
                start_new_session=True,  # Ctrl-C is the grader's to handle
            )

    def set_up(self, inputs: bytes, limits: Limits, without: Collection[str] = (), *, trace: bool = False) -> None:
        """Hand over the inputs and the limits of its children, and wait until it is ready.

        Raises
        ------
        SandboxError
            Where it does not start; it is closed then.
        """
        try:
            self.ready = self._set_up(inputs, limits, without, trace)
        except BaseException:
            self.close()
            raise

    def _set_up(self, inputs: bytes, limits: Limits, without: Collection[str], trace: bool) -> frames.Ready:
        setup = frames.Setup(
            posegraph=str(_POSEGRAPH),
            inputs=inputs,
            memory_mib=limits.memory_mib,
            cpu_seconds=math.ceil(limits.total_cpu) + 1,
            without=sorted(without),
            trace=trace,
        )
        self._control.settimeout(_START_SECONDS)
        try:
            self._control.sendall(frames.pack(setup))
            (length,) = frames.HEADER.unpack(self._receive(frames.HEADER.size))
            ready = frames.decode(self._receive(length), frames.Ready)
        except (OSError, msgspec.MsgspecError) as error:
            words = f"The fork server did not start: {self._last_words() or error}"
            raise (SandboxLost if self.killed else SandboxError)(words) from error
        if ready.error:
            raise SandboxError(f"The fork server did not start: {ready.error}")
        self._control.settimeout(_REPLY_SECONDS)
        return ready

    @property
    def pid(self) -> int:
        """Process id of the fork server."""
        return self._process.pid

    @property
    def killed(self) -> bool:
        """Whether a signal has ended the fork server."""
        with suppress(subprocess.TimeoutExpired):  # its end of the channel closes a moment before it is gone
            self._process.wait(timeout=0.2)
        return (self._process.returncode or 0) < 0

    def fork(self, budget: Budget, output_bytes: int) -> tuple[Channel, int]:
        """Fork a child; it locks itself before it reads anything."""
        data, theirs = socket.socketpair()
        output, their_output = os.pipe()
        channel = Channel(data, output, output_bytes, budget)
        try:
            with theirs:
                self._ask(forkserver.FORK, 0, [theirs.fileno(), their_output])
            _, pid = forkserver.MESSAGE.unpack(self._answer(forkserver.MESSAGE.size))
        except BaseException:
            channel.close()
            raise
        finally:
            os.close(their_output)
        channel.watch(pid)
        return channel, pid

    def kill(self, pid: int) -> None:
        """Have a child killed, and reaped when it is gone; without the fork server it is dead already."""
        with suppress(SandboxError):
            self._ask(forkserver.KILL, pid)

    def wait(self, pid: int) -> str:
        """Have a child killed if it still lives, wait for its end, and say how it ended."""
        self._ask(forkserver.WAIT, pid)
        status, _, _ = forkserver.STATUS.unpack(self._answer(forkserver.STATUS.size))
        return _ending(status)

    def refused(self) -> list[int]:
        """Give the numbers of the system calls that traced children were refused since the last time."""
        self._ask(forkserver.REFUSED, 0)
        (count,) = struct.unpack("<I", self._answer(4))
        return list(struct.unpack(f"<{count}q", self._answer(8 * count)))

    def close(self) -> None:
        """End the fork server; its children die with it."""
        self._control.close()
        try:
            self._process.wait(timeout=5.0)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        if self._process.stderr is not None:
            self._process.stderr.close()

    def _ask(self, operation: bytes, pid: int, descriptors: list[int] | None = None) -> None:
        ancillary = []
        if descriptors:
            ancillary = [(socket.SOL_SOCKET, socket.SCM_RIGHTS, struct.pack(f"{len(descriptors)}i", *descriptors))]
        try:
            self._control.sendmsg([forkserver.MESSAGE.pack(operation, pid)], ancillary)
        except OSError as error:
            raise SandboxLost(f"The fork server has gone: {self._last_words() or error}") from error

    def _answer(self, count: int) -> bytes:
        try:
            return self._receive(count)
        except OSError as error:
            raise SandboxLost(f"The fork server does not answer: {self._last_words() or error}") from error

    def _receive(self, count: int) -> bytes:
        data = b""
        while len(data) < count:
            part = self._control.recv(count - len(data))
            if not part:
                raise ConnectionResetError("it closed the control channel")
            data += part
        return data

    def _last_words(self) -> str:
        if self._process.stderr is None or self._process.stderr.closed or self._process.poll() is None:
            return ""
        lines = self._process.stderr.read().decode("utf-8", "replace").strip().splitlines()
        return lines[-1] if lines else f"it ended with status {self._process.returncode}"


def _library_paths() -> list[str]:
    """Find where numpy and msgspec lie: the fork server looks nowhere else but in the standard library."""
    found = [importlib.util.find_spec(name) for name in ("numpy", "msgspec")]  # numpy is not imported for this
    places = [Path(spec.origin).resolve().parent.parent for spec in found if spec is not None and spec.origin]
    return list(dict.fromkeys(map(str, places)))


def _ending(status: int) -> str:
    if os.WIFSIGNALED(status):
        number = os.WTERMSIG(status)
        if number == signal.SIGKILL:
            return "killed"
        name = signal.Signals(number).name if number in set(signal.Signals) else str(number)
        return f"it crashed the Python interpreter ({name})"
    return f"it ended the Python process (exit status {os.WEXITSTATUS(status)})"
