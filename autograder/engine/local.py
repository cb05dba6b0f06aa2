"""Worker processes on this machine: every core busy, none trusted to live."""

from __future__ import annotations

import contextlib
import multiprocessing
import os
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from multiprocessing.connection import Connection, wait
from typing import Any

import msgspec

from autograder.engine.messages import Answer, Grade, Ready, Trouble, decode_message
from autograder.engine.pool import GIVEN_UP, MAX_LOSSES, Done
from autograder.errors import SandboxError
from autograder.lifeline import postponed
from autograder.sandbox.kernel import ONE_THREAD

MAX_STARTS = 4  # workers in a row that end before they are ready, before the run is given up
MAX_FRAME = 64 * 1024 * 1024


@dataclass
class _Worker:
    process: Any
    connection: Connection
    job: int | None = None
    ready: bool = False


@dataclass
class LocalPool:
    """A pool of worker processes.

    Parameters
    ----------
    orders : callable
        Gives what every worker is told once; asked while the workers start.
    size : int
        How many workers.

    Attributes
    ----------
    confinement : Ready or None
        The level that the first worker reported.
    """

    orders: Callable[[], bytes]
    size: int
    confinement: Ready | None = None
    _told: bytes | None = None
    _workers: list[_Worker] = field(default_factory=list)
    _false_starts: int = 0

    def __enter__(self) -> LocalPool:
        """Start all workers, and wait for one: a machine without locks is noticed before anything is graded."""
        try:
            self._workers = [self._start() for _ in range(self.size)]
            self._told = self.orders()
            for number, each in enumerate(self._workers):
                if not self._tell(each):
                    self._workers[number] = self._start()
            while self.confinement is None:
                deque(self._listen(), maxlen=0)
        except BaseException:
            self.close()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """End all workers."""
        for each in self._workers:
            each.connection.close()
        for each in self._workers:
            each.process.join(timeout=0.5)
            for end in (each.process.terminate, each.process.kill):  # asked first, it ends its fork server too
                if each.process.is_alive():
                    end()
                    each.process.join(timeout=5.0)
        self._workers.clear()

    @property
    def has_a_processor_each(self) -> bool:
        """Whether there are no more workers than processors."""
        return self.size <= default_workers()

    def run(self, jobs: Iterable[tuple[int, Grade]], done: Done) -> None:
        """Run all jobs, at most one a worker at a time; call `done` as each ends, in any order."""
        waiting = deque(jobs)
        known = dict(waiting)
        losses: dict[int, int] = {}
        unfinished = len(waiting)
        while unfinished:
            for each in self._workers:
                if each.ready and each.job is None and waiting:
                    self._give(each, *waiting.popleft())
            for job, answer in self._listen():
                if answer is None:
                    losses[job] = losses.get(job, 0) + 1
                    if losses[job] < MAX_LOSSES:
                        waiting.appendleft((job, known[job]))
                        continue
                again = done(job, answer or GIVEN_UP)
                if again is None:
                    unfinished -= 1
                else:
                    known[job] = again
                    waiting.append((job, again))

    def _listen(self) -> Iterator[tuple[int, Answer | None]]:
        """Wait for what workers say; give every answer with its job, and None for the job of one that is lost."""
        for connection in wait([each.connection for each in self._workers]):
            each = next(one for one in self._workers if one.connection is connection)
            job = each.job
            try:
                answer = self._receive(each)
            except (EOFError, OSError):
                self._workers[self._workers.index(each)] = self._replace(each)
                if job is not None:
                    yield job, None
            else:
                if job is not None and answer is not None:
                    yield job, answer

    def _start(self) -> _Worker:
        context = multiprocessing.get_context("spawn")  # a fresh interpreter: nothing of the client is inherited
        while True:
            started = self._start_once(context)
            if started is not None:
                return started

    def _start_once(self, context: multiprocessing.context.SpawnContext) -> _Worker | None:
        """Start a worker, and tell it the orders if they are known; None where it was killed before it had them."""
        ours, theirs = context.Pipe()
        process = context.Process(target=_serve, args=(theirs,), daemon=True)
        try:
            with _as_a_worker():
                process.start()
        except BrokenPipeError:
            ours.close()
            self._count_false_start("killed at once")
            return None
        finally:
            theirs.close()
        started = _Worker(process, ours)
        return started if self._told is None or self._tell(started) else None

    def _tell(self, each: _Worker) -> bool:
        """Send the orders; False where the worker was killed before it had them.

        They go over the connection, not with the process: starting a process waits for its
        arguments to be read, and would wait for ever for one that dies before.
        """
        try:
            each.connection.send_bytes(self._told or b"")
        except (BrokenPipeError, ConnectionResetError):
            each.connection.close()
            each.process.join()
            self._count_false_start("ended before it had its orders")
            return False
        return True

    def _replace(self, lost: _Worker) -> _Worker:
        lost.connection.close()
        lost.process.join()
        if not lost.ready:
            self._count_false_start(f"status {lost.process.exitcode}")
        return self._start()

    def _count_false_start(self, how: str) -> None:
        self._false_starts += 1
        if self._false_starts >= MAX_STARTS:
            raise SandboxError(
                f"{MAX_STARTS} worker processes in a row ended before they were ready (the last: {how}); "
                "`autograder doctor` may say why."
            )

    def _give(self, each: _Worker, number: int, job: Grade) -> None:
        each.job = number
        with contextlib.suppress(BrokenPipeError, ConnectionResetError):  # noticed when its connection is read
            each.connection.send_bytes(msgspec.msgpack.encode(job))

    def _receive(self, each: _Worker) -> Answer | None:
        message = decode_message(each.connection.recv_bytes(MAX_FRAME))
        if isinstance(message, Trouble) and message.fatal:
            raise SandboxError(message.message)
        if isinstance(message, Ready):
            each.ready = True
            self._false_starts = 0
            self.confinement = self.confinement or message
            return None
        each.job = None
        return message


@contextlib.contextmanager
def _as_a_worker() -> Iterator[None]:
    """Give what a process inherits from its start on: one thread for numpy, and no ear for Ctrl-C.

    Ctrl-C is the client's to handle, even while a worker still imports; the client hears it a moment later.
    """
    before = {name: os.environ.get(name) for name in ONE_THREAD}
    os.environ.update(ONE_THREAD)
    try:
        with postponed():
            yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def _serve(connection: Connection) -> None:
    """Be a worker: what only workers need is imported in their own process."""
    from autograder.engine import worker  # noqa: PLC0415 - the client never needs it

    worker.main(connection)


def default_workers() -> int:
    """Return the number of processors that this process may use.

    Examples
    --------
    >>> default_workers() >= 1
    True
    """
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
