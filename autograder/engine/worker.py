"""One worker process: its own fork server, one submission at a time, from source to verdicts."""

from __future__ import annotations

import contextlib
import os
import signal
import time
from multiprocessing.connection import Connection

import msgspec

from autograder.engine.collect import collect
from autograder.engine.corpus import load_corpus
from autograder.engine.judge import Judge
from autograder.engine.plan import Plan, make_plan
from autograder.errors import AutograderError
from autograder.sandbox.frames import Source
from autograder.sandbox.host import Limits, Sandbox
from autograder.stages.catalogue import stage
from autograder.verdicts import StageVerdict


class Orders(msgspec.Struct, frozen=True):
    """What a worker is told once: the exam and the rules."""

    corpus: bytes
    stages: tuple[str, ...]
    points: dict[str, float]
    time_limit: float
    memory_mib: int
    output_mib: int
    allow_unconfined: bool
    follow_through: float

    def plan(self) -> Plan:
        """Lay out the run."""
        return make_plan(
            [stage(name) for name in self.stages], self.points, load_corpus(self.corpus), self.follow_through
        )

    def limits(self) -> Limits:
        """Return the limits of a child."""
        return Limits(
            cpu_seconds=self.time_limit, memory_mib=self.memory_mib, output_bytes=self.output_mib * 1024 * 1024
        )


class Ready(msgspec.Struct, frozen=True, tag=True):
    """The worker's first message: the confinement that it gives."""

    level: str
    detail: str


class Graded(msgspec.Struct, frozen=True, tag=True):
    """What became of one submission."""

    stages: tuple[StageVerdict, ...]
    notes: tuple[str, ...]
    ran_out: bool
    seconds: float


class Trouble(msgspec.Struct, frozen=True, tag=True):
    """The grader's own fault, in words."""

    message: str
    fatal: bool = False


Message = Ready | Graded | Trouble
_decoder: msgspec.msgpack.Decoder[Message] = msgspec.msgpack.Decoder(Message)


def decode_message(data: bytes) -> Message:
    """Read what a worker sent."""
    return _decoder.decode(data)


def main(connection: Connection, orders: bytes) -> None:
    """Serve until the other end closes: sources in, verdicts out."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the parent's to handle

    def send(message: Message) -> None:
        connection.send_bytes(msgspec.msgpack.encode(message))

    with contextlib.suppress(BrokenPipeError, EOFError, ConnectionResetError):
        told = msgspec.msgpack.decode(orders, type=Orders)
        try:
            plan = told.plan()
            sandbox = Sandbox(plan.inputs, told.limits(), allow_unconfined=told.allow_unconfined)
        except AutograderError as error:
            send(Trouble(str(error), fatal=True))
            return
        judge = Judge(plan)
        with sandbox:
            send(Ready(sandbox.confinement.level, sandbox.confinement.detail))
            while True:
                source = msgspec.msgpack.decode(connection.recv_bytes(), type=Source)
                send(_grade(judge, sandbox, source))


def _grade(judge: Judge, sandbox: Sandbox, source: Source) -> Message:
    began = time.perf_counter()
    try:
        with sandbox.open(source) as session:
            collected = collect(session, judge.plan)
        stages = judge.judge(collected)
    except Exception as error:
        if os.environ.get("AUTOGRADER_DEBUG"):
            raise
        return Trouble(f"The grader failed ({type(error).__name__}: {error}).")
    notes = tuple(f"{note.where}: {note.message}" for note in collected.loaded.notes)
    return Graded(stages, notes, collected.ran_out, time.perf_counter() - began)
