"""The fork server: a fresh Python that loads numpy and the inputs once, and forks a child a submission.

It runs no code of a submission and sees none. Over the control channel come messages of nine bytes,
an operation and a number; a fork comes with two descriptors for the child.
"""

from __future__ import annotations

import gc
import importlib
import os
import select
import signal
import socket
import struct
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .child import Child

MESSAGE = struct.Struct("<cq")
STATUS = struct.Struct("<qqq")  # wait status, CPU time in microseconds, largest memory in KiB
FORK, KILL, WAIT, REFUSED = b"F", b"K", b"W", b"R"
_PATIENCE = 500  # milliseconds between looks at whether the grader is still there
_CONTROL = 20  # the grader's number may be any; a child closes what lies below a bound
_TOKEN = struct.calcsize("i")


def serve(control: socket.socket, grader: int) -> None:
    """Set up, report, and fork children until the grader goes away."""
    from . import frames, policy  # noqa: PLC0415  # numpy and msgspec are found only after the paths are set

    try:
        policy.preload()  # while the grader is still making the inputs
        child, ready = _set_up(frames.decode(_receive(control), frames.Setup))
    except Exception as error:  # noqa: BLE001  # whatever went wrong, the grader has to hear of it
        control.sendall(frames.pack(frames.Ready("", "", 0, f"{type(error).__name__}: {error}")))
        return
    control.sendall(frames.pack(ready))
    try:
        _loop(control, grader, child)
    except (BrokenPipeError, ConnectionResetError):
        pass
    finally:
        os._exit(0)  # at once: there is nothing to tidy up, and the grader waits


def _set_up(setup: Any) -> tuple[Child, Any]:
    from . import batches, frames  # noqa: PLC0415  # as above
    from .child import Child, furnish  # noqa: PLC0415  # as above
    from .lockdown import Lock  # noqa: PLC0415  # as above

    posegraph = _load_posegraph(setup.posegraph)
    inputs = frames.decode(setup.inputs, frames.Inputs)
    shared: batches.Shared = {}
    objects = [batches.build_object(data, posegraph, shared) for data in inputs.objects]
    plans = [batches.prepare(batch, objects, posegraph, shared) for batch in inputs.batches]
    del shared
    import numpy as np  # noqa: PLC0415  # as above

    np.random.seed(0)
    os.environ.clear()
    sys.path.clear()
    sys.path_importer_cache.clear()
    furnish()
    lock = Lock(setup.memory_mib << 20, setup.cpu_seconds, frozenset(setup.without), setup.trace)
    lock.prepare()
    del inputs
    gc.collect()
    gc.freeze()
    return Child(lock, objects, plans, posegraph), frames.Ready(lock.seccomp, lock.landlock, lock.abi, "")


def _load_posegraph(path: str) -> Any:
    from importlib.util import module_from_spec, spec_from_file_location  # noqa: PLC0415  # used once

    spec = spec_from_file_location("posegraph", path)
    if spec is None or spec.loader is None:
        raise ImportError(f"{path} cannot be loaded")
    module = module_from_spec(spec)
    sys.modules["posegraph"] = module
    spec.loader.exec_module(module)
    return module


def _loop(control: socket.socket, grader: int, child: Child) -> None:
    poll = select.poll()
    poll.register(control, select.POLLIN)
    dying: set[int] = set()
    refusals = Refusals(poll)
    while True:
        dying = {pid for pid in dying if os.waitpid(pid, os.WNOHANG)[0] == 0}
        ready = [descriptor for descriptor, _ in poll.poll(20 if dying else _PATIENCE)]
        refusals.answer(ready)
        if control.fileno() not in ready:
            if os.getppid() != grader:
                return
            continue
        message, ancillary, _, _ = control.recvmsg(MESSAGE.size, socket.CMSG_LEN(2 * _TOKEN))
        if len(message) < MESSAGE.size:
            return
        operation, pid = MESSAGE.unpack(message)
        if operation == FORK:
            pid = _fork(child, *struct.unpack("2i", ancillary[0][2]))
            if child.traced:
                refusals.watch(pid)
            control.sendall(MESSAGE.pack(FORK, pid))
        elif operation == KILL:
            os.kill(pid, signal.SIGKILL)
            dying.add(pid)
        elif operation == WAIT:
            os.kill(pid, signal.SIGKILL)
            _, status, usage = os.wait4(pid, 0)
            microseconds = int(1e6 * (usage.ru_utime + usage.ru_stime))
            control.sendall(STATUS.pack(status, microseconds, usage.ru_maxrss))
        elif operation == REFUSED:
            control.sendall(refusals.taken())


def _fork(child: Child, data: int, output: int) -> int:
    me = os.getpid()
    pid = os.fork()
    if pid == 0:
        child.live(me, data, output)
    os.close(data)
    os.close(output)
    return pid


class Refusals:
    """The system calls that traced children were refused."""

    def __init__(self, poll: select.poll) -> None:
        self._poll = poll
        self._tracers: dict[int, Any] = {}
        self._numbers: list[int] = []

    def watch(self, pid: int) -> None:
        """Answer from now on for this child's filter."""
        from .child import DATA  # noqa: PLC0415  # as above
        from .tracing import Tracer  # noqa: PLC0415  # only while tracing

        tracer = Tracer(pid, DATA + 1)
        self._tracers[tracer.descriptor] = tracer
        self._poll.register(tracer.descriptor, select.POLLIN)

    def answer(self, ready: list[int]) -> None:
        """Refuse what waits on these descriptors, and note it."""
        for descriptor in ready:
            if descriptor in self._tracers:
                number = self._tracers[descriptor].answer()
                if number is not None:
                    self._numbers.append(number)
                else:
                    self._poll.unregister(descriptor)
                    self._tracers.pop(descriptor).close()

    def taken(self) -> bytes:
        """Give all numbers noted since the last time, behind their count."""
        numbers, self._numbers = self._numbers, []
        return struct.pack(f"<I{len(numbers)}q", len(numbers), *numbers)


def _receive(control: socket.socket) -> bytes:
    (length,) = struct.unpack("<I", _read(control, 4))
    return _read(control, length)


def _read(control: socket.socket, count: int) -> bytes:
    data = bytearray()
    while len(data) < count:
        part = control.recv(min(count - len(data), 1 << 20))
        if not part:
            raise EOFError("the grader closed the control channel")
        data += part
    return bytes(data)


def _boot() -> None:
    """Load this file again as part of its package, so that relative imports work, and serve.

    Arguments: the descriptor of the control channel, the grader's process id, the paths where
    numpy and msgspec lie.
    """
    from importlib.util import module_from_spec, spec_from_file_location  # noqa: PLC0415  # used once

    descriptor, grader, *paths = sys.argv[1:]
    sys.path.extend(paths)
    folder = Path(__file__).resolve().parent
    spec = spec_from_file_location("sandbox", folder / "__init__.py", submodule_search_locations=[str(folder)])
    if spec is None or spec.loader is None:
        raise ImportError(f"{folder} cannot be loaded")
    package = module_from_spec(spec)
    sys.modules["sandbox"] = package
    spec.loader.exec_module(package)
    import fcntl  # noqa: PLC0415  # the grader's side, which imports this file, must do without

    control = fcntl.fcntl(int(descriptor), fcntl.F_DUPFD_CLOEXEC, _CONTROL)
    os.close(int(descriptor))
    importlib.import_module("sandbox.forkserver").serve(socket.socket(fileno=control), int(grader))


if __name__ == "__main__":
    _boot()
