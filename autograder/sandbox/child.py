"""The life of a child: lock, say so, and only then read what a stranger wrote."""

from __future__ import annotations

import io
import os
import random
import sys
import warnings
from collections.abc import Sequence
from types import ModuleType
from typing import Any, NoReturn

from . import batches, canary, frames
from .frames import Call, Load, Probe, Replace, Run, Trouble
from .lockdown import Lock
from .submission import Submission

DATA, OUTPUT, ERRORS = 3, 1, 2
LOCK_FAILED = 70  # exit status, before anything of a submission was read
_BALLAST = 1 << 20  # bytes given back when memory has run out, so that the child can still say so


class Child:
    """What a child inherits from the fork server, and what it does with it."""

    def __init__(
        self, lock: Lock, objects: Sequence[Any], plans: Sequence[batches.Plan], posegraph: ModuleType
    ) -> None:
        self._lock = lock
        self._objects = objects
        self._plans = plans
        self._posegraph = posegraph
        self._submission: Submission | None = None
        self._ballast: bytearray | None = None

    @property
    def traced(self) -> bool:
        """Whether the fork server answers for the filter."""
        return self._lock.trace and not self._lock.seccomp

    def live(self, parent: int, data: int, output: int) -> NoReturn:
        """Lock this process and answer requests until the channel closes."""
        try:
            self._lock.tie(parent)
            _arrange(data, output)
            self._lock.close(DATA + 1)
        except BaseException:  # noqa: BLE001  # a child that is not locked must not go on, whatever the reason
            os._exit(LOCK_FAILED)
        try:
            _send(frames.Hello(0))
            self._ballast = bytearray(_BALLAST)
            while True:
                self._answer(frames.request_decoder.decode(_receive()))
        finally:
            os._exit(0)

    def _answer(self, request: frames.Request) -> None:
        try:
            if isinstance(request, Load):
                reply: Any = self._load(request)
            elif isinstance(request, Probe):
                reply = frames.ProbeReport(request.nonce, canary.attempts())
            elif isinstance(request, Replace):
                reply = self._replace(request)
            else:
                reply = self._call(request)
            message = frames.pack(reply)
        except MemoryError:
            self._ballast = None
            message = frames.pack(Trouble(request.nonce, "memory"))
        _write(message)

    def _load(self, request: Load) -> frames.LoadReport:
        def report(cell: int, number: int, line: int) -> None:
            _send(frames.Progress(request.nonce, cell, number, line))

        wanted = {plan.function for plan in self._plans}
        self._submission = submission = Submission(request.source, report, wanted)
        submission.execute(set(request.skip), request.stop)
        found = submission.functions(), submission.remarks, submission.answers(), submission.fates()
        return frames.LoadReport(request.nonce, *found)

    def _replace(self, request: Replace) -> frames.Replaced:
        if self._submission is not None:
            self._submission.replace(request.tables, self._objects, self._posegraph)
        return frames.Replaced(request.nonce)

    def _call(self, request: Run | Call) -> frames.BatchReport:
        if isinstance(request, Run):
            plan = self._plans[request.batch]
        else:
            plan = batches.prepare(request.batch, self._objects, self._posegraph)
        function = self._submission.function(plan.function) if self._submission is not None else None
        return batches.call(plan, function, request.nonce)


def furnish() -> None:
    """Give this process, and so every child, the streams and settings that a submission finds.

    The stream writes to the descriptor of the output, whatever a child puts there.
    """
    reading, writing = os.pipe()  # so that the stream is one that cannot seek, as in the child
    os.dup2(writing, OUTPUT)
    os.close(reading)
    os.close(writing)
    raw = io.FileIO(OUTPUT, "w", closefd=False)
    stream = io.TextIOWrapper(io.BufferedWriter(raw, 1 << 16), encoding="utf-8", errors="replace")
    for name in ("stdout", "stderr", "__stdout__", "__stderr__"):
        setattr(sys, name, stream)
    sys.stdin = io.StringIO()
    sys.argv = ["slam1d.py"]
    warnings.simplefilter("ignore", SyntaxWarning)


def _arrange(data: int, output: int) -> None:
    """Put the descriptors in their places."""
    os.dup2(output, OUTPUT)
    os.dup2(output, ERRORS)
    os.dup2(data, DATA)  # last: the output may have come as this number
    random.seed(0)  # Python seeds it anew in every fork; two runs of a submission must agree


def _send(frame: Any) -> None:
    _write(frames.pack(frame))


def _write(message: bytes) -> None:
    view = memoryview(message)
    while view:
        view = view[os.write(DATA, view) :]


def _receive() -> bytes:
    (length,) = frames.HEADER.unpack(_read(frames.HEADER.size))
    return _read(length)


def _read(count: int) -> bytes:
    parts = []
    while count:
        part = os.read(DATA, min(count, 1 << 20))
        if not part:
            os._exit(0)  # the grader has gone or is done with this child
        parts.append(part)
        count -= len(part)
    return b"".join(parts)
