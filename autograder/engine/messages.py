"""What a client and its workers say to each other: msgpack messages, the same on one machine and on many."""

from __future__ import annotations

from typing import Any

import msgspec

from autograder.sandbox.frames import Source
from autograder.verdicts import Reported, StageVerdict


class Orders(msgspec.Struct, frozen=True):
    """What a worker is told once: the exam and the rules."""

    exam: bytes
    stages: tuple[str, ...]
    points: dict[str, float]
    time_limit: float
    memory_mib: int
    output_mib: int
    allow_unconfined: bool
    follow_through: float


class Grade(msgspec.Struct, frozen=True):
    """Ask to run, judge and explain one submission.

    `sheet` is the variant on record: its identifier, and its graph and iterates as a plain case;
    None stands for the worked example. `markdown_answers` is what a notebook says under the written questions.
    Once something runs out of time by the clock alone, nothing more is asked, unless the submission runs `alone` on
    its processor to confirm that.
    """

    source: Source
    sheet: tuple[str, list[Any]] | None = None
    markdown_answers: dict[str, str] = {}
    alone: bool = False


class Ready(msgspec.Struct, frozen=True, tag=True):
    """The worker's first message: the confinement that it gives."""

    level: str
    detail: str


class Graded(msgspec.Struct, frozen=True, tag=True):
    """What became of one submission.

    `unsure` where it ran out of time by the clock alone; `flags` say to staff which words are missing beside its marks,
    `in_vain` says of functions that somebody tried to write why they are not there.
    """

    stages: tuple[StageVerdict, ...]
    notes: tuple[str, ...]
    unsure: bool
    seconds: float
    written: dict[str, str]
    iterates: list[list[float]] | None
    confinement: str = ""
    flags: tuple[str, ...] = ()
    in_vain: tuple[str, ...] = ()
    reported: Reported | None = None


class Trouble(msgspec.Struct, frozen=True, tag=True):
    """The grader's own fault, in words; `lost` where nothing is known but that a worker has gone."""

    message: str
    fatal: bool = False
    lost: bool = False


Answer = Graded | Trouble
Message = Ready | Answer
_decoder: msgspec.msgpack.Decoder[Message] = msgspec.msgpack.Decoder(Message)


def decode_message(data: bytes) -> Message:
    """Read what a worker sent."""
    return _decoder.decode(data)
