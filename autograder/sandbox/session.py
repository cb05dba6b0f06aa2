"""One submission as the grader sees it: loaded once, called batch by batch, in a child that can be replaced."""

from __future__ import annotations

import secrets
from collections.abc import Sequence
from dataclasses import replace
from types import TracebackType

from autograder.errors import SandboxError
from autograder.sandbox import frames
from autograder.sandbox.channel import WALL_FACTOR, Budget, Channel, Ended
from autograder.sandbox.fates import fates_of
from autograder.sandbox.frames import Batch, Source, Table
from autograder.sandbox.outputs import (
    Expected,
    Failure,
    Loaded,
    Note,
    Outputs,
    Violation,
    place,
    printable,
    read_answers,
    read_outputs,
)
from autograder.sandbox.server import Limits, Server

_STATUS: dict[str, frames.Status] = {"timeout": "timeout", "budget": "timeout", "memory": "memory"}
_MOST_RESTARTS = 20  # statements that kill the child, before the rest of the submission is left out


class Session:
    """One submission; a context manager.

    Its child is replaced without a word when it has died or was killed: the submission is loaded
    again, without the statements that had to be skipped, as long as its budget lasts.
    """

    def __init__(self, server: Server, limits: Limits, expected: Sequence[Expected], source: Source) -> None:
        self._server = server
        self._limits = limits
        self._expected = expected
        self._source = frames.Source(
            source.kind, [_sendable(cell) for cell in source.cells], _sendable(source.name), source.labels
        )
        self._budget = self._limits.budget()
        self._channel: Channel | None = None
        self._pid = 0
        self._loaded: Loaded | None = None
        self._skip: dict[tuple[int, int], tuple[int, Note]] = {}  # (cell, number) -> line and note
        self._stop: tuple[int, int] | None = None
        self._given_up: Failure | None = None
        self.sure = True  # False once a statement ran out of time by the clock alone

    def load(self) -> Loaded:
        """Execute the submission, statement by statement, and say what it defines."""
        if self._loaded is None:
            self._start()
        return self._loaded or Loaded(notes=tuple(note for _, note in self._skip.values()))

    @property
    def left(self) -> Budget:
        """What the submission may still use, as it stands now."""
        return replace(self._budget)

    def restore(self, budget: Budget) -> None:
        """Give back what an attempt used that does not count."""
        self._budget = replace(budget)

    def run(self, batch: int, share: float = 1.0) -> Outputs | Failure:
        """Make the calls of a batch of the inputs, in a share of the time of a check."""
        nonce = secrets.randbits(62)
        return self._ask(frames.Run(nonce, batch), nonce, self._expected[batch], share)

    def call(self, batch: Batch, share: float = 1.0) -> Outputs | Failure:
        """Make the calls of a batch that comes with the request; integers index the objects of the inputs."""
        nonce = secrets.randbits(62)
        return self._ask(frames.Call(nonce, batch), nonce, Expected.of(batch), share)

    def replace(self, tables: list[Table]) -> Failure | None:
        """Begin again in a fresh child, with functions that answer from tables in the place of the submission's own.

        They stand there until that child ends: `fresh` ends it, and so does a call that fails.
        """
        self._discard()
        nonce = secrets.randbits(62)
        reply = self._exchange(frames.Replace(nonce, tables), nonce, frames.LOAD_BOUND, 1.0)
        if isinstance(reply, frames.Replaced):
            return None
        return (
            reply
            if isinstance(reply, Failure)
            else self._failure(Violation("a reply is not of the kind that was asked for"), 1.0)
        )

    def fresh(self) -> None:
        """Throw the child away: the next call happens in one that has seen no call before."""
        self._discard()

    def afresh(self) -> None:
        """Begin again, in a fresh child and with all the time that a submission has."""
        self._discard()
        self._budget = self._limits.budget()

    def close(self) -> None:
        """End the child."""
        self._discard()

    def __enter__(self) -> Session:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()

    def _ask(
        self, request: frames.Run | frames.Call, nonce: int, expected: Expected, share: float
    ) -> Outputs | Failure:
        reply = self._exchange(request, nonce, expected.bound, share)
        if isinstance(reply, Failure):
            return reply
        try:
            if isinstance(reply, frames.BatchReport):
                return read_outputs(reply, expected, self._source)
            raise Violation("a reply is not of the kind that was asked for")
        except Violation as end:
            return self._failure(end, share)

    def _exchange(self, request: frames.Request, nonce: int, bound: int, share: float) -> frames.Reply | Failure:
        """Send a request to the child, which is started where there is none, and wait for its reply."""
        if self._channel is None:
            self._start()
        if self._channel is None:
            return self._given_up or Failure("died", "the submission could not be loaded again")
        try:
            self._channel.require_silence()
            self._channel.begin(frames.pack(request), nonce)
            reply = self._channel.reply(bound, share * self._limits.cpu_seconds)
            self._channel.require_silence()
            if isinstance(reply, frames.Trouble):
                raise Ended("memory")
            return reply
        except (Ended, Violation) as end:
            return self._failure(end, share)

    def _start(self) -> None:
        """Fork and load, leaving out one more statement each time that the child does not survive one."""
        while self._given_up is None:
            at: frames.Progress | None = None
            nonce = secrets.randbits(62)
            self._channel, self._pid = self._server.fork(self._budget, self._limits.output_bytes)
            try:
                request = frames.Load(nonce, self._source, list(self._skip), self._stop)
                self._channel.begin(frames.pack(request), nonce)
                self._greet(self._channel)
                while True:
                    reply = self._channel.reply(frames.LOAD_BOUND, self._limits.cpu_seconds)
                    if not isinstance(reply, frames.Progress):
                        break
                    if at is not None and (reply.cell, reply.number) <= (at.cell, at.number):
                        raise Violation("statements are reported out of order")
                    at = reply
                self._channel.require_silence()
                if isinstance(reply, frames.Trouble):
                    raise Ended("memory")
                if not isinstance(reply, frames.LoadReport):
                    raise Violation("a reply is not of the kind that was asked for")
                self._loaded = self._read(reply)
                return
            except (Ended, Violation) as end:
                self._leave_out(at, self._failure(end))

    def _greet(self, channel: Channel) -> None:
        """Wait until the child says that its lock is on; that it is not is no fault of the submission."""
        try:
            hello = channel.reply(frames.LOAD_BOUND, 10.0, nonce=0)
        except Ended as end:
            if end.reason == "budget":
                raise
            status = self._server.wait(self._pid)
            self._channel = None
            channel.close()
            raise SandboxError(f"A child of the fork server could not be locked ({end.reason}, {status}).") from end
        if not isinstance(hello, frames.Hello):
            raise SandboxError("A child of the fork server spoke before its lock was on.")

    def _leave_out(self, at: frames.Progress | None, failure: Failure) -> None:
        """Note the statement at which the child ended, and leave it out from now on."""
        if at is None or at.cell >= len(self._source.cells):
            self._given_up = failure
            return
        self.sure = self.sure and failure.sure
        key = (at.cell, at.number)
        message = failure.message
        if failure.reason == "budget" or self._stop is not None or key in self._skip:
            self._given_up = failure
        elif len(self._skip) >= _MOST_RESTARTS:
            self._stop = key
            message += "; it is one of too many, so nothing from here on was executed"
        note = Note(place(self._source, at.cell, at.line), _STATUS.get(failure.reason, "died"), message)
        self._skip.setdefault(key, (at.line, note))

    def _read(self, report: frames.LoadReport) -> Loaded:
        placed = [
            (
                (remark.cell, remark.line),
                Note(place(self._source, remark.cell, remark.line), remark.status, printable(remark.message)),
            )
            for remark in report.remarks
        ]
        placed += [((cell, line), note) for (cell, _), (line, note) in self._skip.items()]
        placed.sort(key=lambda entry: entry[0])
        return Loaded(
            frozenset(report.functions),
            tuple(note for _, note in placed),
            read_answers(report.answers),
            fates_of(self._source, report),
        )

    def _failure(self, end: Ended | Violation, share: float = 1.0) -> Failure:
        """Put into words why the child ended, and make sure that it has."""
        limits = self._limits
        seconds = share * limits.cpu_seconds
        reason = end.reason if isinstance(end, Ended) else "violation"
        died = self._discard(ask=True)
        if reason == "died":
            if died.startswith("killed"):
                reason = "memory"
            else:
                return Failure("died", died)
        words = {
            "timeout": f"it took longer than {seconds:g} s of computing, or {WALL_FACTOR * seconds:g} s of waiting",
            "memory": f"it needed more than {limits.memory_mib} MiB of memory",
            "output": f"it printed more than {limits.output_bytes / 2**20:g} MiB",
            "violation": "it wrote to the grader's own channel instead of returning a value",
            "budget": f"all of the submission together took longer than {limits.total_cpu:g} s of computing",
        }
        return Failure(reason, words[reason], end.sure if isinstance(end, Ended) else True)

    def _discard(self, *, ask: bool = False) -> str:
        channel, self._channel = self._channel, None
        if channel is None:
            return ""
        channel.close()
        if ask:
            return self._server.wait(self._pid)
        self._server.kill(self._pid)
        return ""


def _sendable(text: str) -> str:
    return text.encode("utf-8", "replace").decode("utf-8")
