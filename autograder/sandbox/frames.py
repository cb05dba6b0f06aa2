"""The frames that cross the border: msgpack structs behind a length, raw float64 bytes inside.

A frame is a little-endian u32 length and as many bytes of msgpack. Every request carries a nonce
that its replies must repeat. What may come from a child holds flat bytes where a message could
otherwise be small on the wire and large in memory.
"""

from __future__ import annotations

import struct
from enum import IntEnum
from typing import Annotated, Any, Literal, TypeVar

import msgspec
from msgspec import Meta

from .carried import Argument as Argument  # noqa: PLC0414  # read from here
from .carried import Array as Array  # noqa: PLC0414  # read from here
from .carried import Batch as Batch  # noqa: PLC0414  # read from here
from .carried import Frame as Frame  # noqa: PLC0414  # read from here
from .carried import GraphData as GraphData  # noqa: PLC0414  # read from here
from .carried import RangingData as RangingData  # noqa: PLC0414  # read from here
from .carried import Table as Table  # noqa: PLC0414  # read from here

HEADER = struct.Struct("<I")
MAX_DIMENSIONS = 8
MAX_REASONS = 64  # different ones, in one batch
MAX_REASON = 300  # characters
MAX_WRITTEN = 20_000  # characters of one written answer
MAX_FUNCTIONS = 4096
MAX_NOTES = 256
LOAD_BOUND = 1 << 20  # bytes of one reply while a submission is loaded

Nonce = Annotated[int, Meta(ge=0, le=2**63 - 1)]
Count = Annotated[int, Meta(ge=0, le=2**31 - 1)]
Ordinal = Annotated[int, Meta(ge=-1, le=2**31 - 1)]
Status = Literal["error", "syntax", "timeout", "memory", "died", "forbidden", "skipped"]


class Outcome(IntEnum):
    """How one call ended."""

    OK = 0
    RAISED = 1
    BAD_VALUE = 2
    FORBIDDEN = 3
    MEMORY = 4
    UNFINISHED = 5


class Kind(IntEnum):
    """What a value was before it became float64; advisory, as everything that a child says of itself."""

    FLOAT_ARRAY = 0
    INTEGER_ARRAY = 1
    LIST = 2
    MATRIX = 3
    BOOL_ARRAY = 4
    FLOAT32_ARRAY = 5
    SCALAR = 6
    OTHER = 7


class Inputs(Frame, tag="inputs"):
    """All that the fork server builds once and every child inherits: objects, then batches."""

    objects: list[GraphData | RangingData]
    batches: list[Batch]


class Source(Frame, tag="source"):
    """What was handed in: a module has one cell, a notebook its code cells in order."""

    kind: Literal["module", "notebook"]
    cells: list[str]
    name: str
    labels: list[str] = []
    """What each cell is called where it is shown; without them cells are counted."""


class Load(Frame, tag="load"):
    """Ask to execute a submission; `skip` names statements (cell, number) that are left out.

    Nothing from `stop` on, in the order of the text, is executed.
    """

    nonce: Nonce
    source: Source
    skip: list[tuple[int, int]]
    stop: tuple[int, int] | None


class Run(Frame, tag="run"):
    """Ask for the calls of a batch that the fork server prepared."""

    nonce: Nonce
    batch: int


class Call(Frame, tag="call"):
    """Ask for the calls of a batch that comes with the request."""

    nonce: Nonce
    batch: Batch


class Replace(Frame, tag="replace"):
    """Ask to put functions that answer from tables in the place of the submission's own."""

    nonce: Nonce
    tables: list[Table]


class Replaced(Frame, tag="replaced"):
    """The tables are in place."""

    nonce: Nonce


class Probe(Frame, tag="probe"):
    """Ask a canary what it can do although the lock is on."""

    nonce: Nonce


Request = Load | Run | Call | Replace | Probe


class Hello(Frame, tag="hello"):
    """The first frame of a child: its lock is on, it has read nothing yet."""

    nonce: Nonce


class Progress(Frame, tag="progress"):
    """The statement that is about to run; number -1 while a cell is parsed."""

    nonce: Nonce
    cell: Count
    number: Ordinal
    line: Count


class Remark(Frame, tag="remark"):
    """A statement that was skipped, and why."""

    cell: Count
    line: Count
    status: Status
    message: str


class AnswerData(Frame, tag="answers"):
    """The four answers as found; `bad` says in words which could not be used."""

    iterates_shape: Annotated[tuple[Count, ...], Meta(max_length=MAX_DIMENSIONS)] | None
    iterates: bytes
    conclusion: Annotated[str, Meta(max_length=MAX_REASON)] | None
    written_2: Annotated[str, Meta(max_length=MAX_WRITTEN)] | None
    written_3: Annotated[str, Meta(max_length=MAX_WRITTEN)] | None
    bad: Annotated[str, Meta(max_length=4 * MAX_REASON)]


class Fate(Frame, tag="fate"):
    """What became of a function that is asked for, where it is not simply there, or not the one meant.

    `cell` and `line` say where it was written or tried, `by_cell` and `by_line` what took its place.
    """

    name: Annotated[str, Meta(max_length=64)]
    how: Literal["failed", "skipped", "replaced", "deleted", "redefined", "inside", "value", "near"]
    cell: Count
    line: Count
    by_cell: Count
    by_line: Count
    words: Annotated[str, Meta(max_length=MAX_REASON)]


class LoadReport(Frame, tag="loaded"):
    """What a submission defines, what of it was skipped, and what became of the functions that are asked for."""

    nonce: Nonce
    functions: Annotated[list[Annotated[str, Meta(max_length=64)]], Meta(max_length=MAX_FUNCTIONS)]
    remarks: Annotated[list[Remark], Meta(max_length=MAX_NOTES)]
    answers: AnswerData
    fates: Annotated[list[Fate], Meta(max_length=64)] = []


class BatchReport(Frame, tag="results"):
    """The values of a batch, flat.

    `outcome` has a byte a case; `kinds` and `dimensions` have a byte a value; `sizes` (int64) holds
    the shapes one after the other; `data` the float64 elements of all values. `reasons` holds, for each of the
    words that were said, the calls (int32) of which they were.
    """

    nonce: Nonce
    outcome: bytes
    kinds: bytes
    dimensions: bytes
    sizes: bytes
    data: bytes
    reasons: Annotated[dict[Annotated[str, Meta(max_length=MAX_REASON)], bytes], Meta(max_length=MAX_REASONS)]
    mutated: Ordinal


class Trouble(Frame, tag="trouble"):
    """The child could not put a reply together."""

    nonce: Nonce
    reason: Literal["memory"]


class ProbeReport(Frame, tag="probed"):
    """Which attempts of a canary succeeded."""

    nonce: Nonce
    succeeded: Annotated[list[Annotated[str, Meta(max_length=64)]], Meta(max_length=64)]


class Setup(Frame, tag="setup"):
    """The first message to a fork server."""

    posegraph: str
    inputs: bytes
    memory_mib: int
    cpu_seconds: int
    without: list[str]
    trace: bool


class Ready(Frame, tag="ready"):
    """The fork server's answer: which locks it has; `error` where it could not start."""

    seccomp: str
    landlock: str
    abi: int
    error: str


Reply = Hello | Progress | LoadReport | BatchReport | Replaced | Trouble | ProbeReport
_AnyFrame = TypeVar("_AnyFrame")

_encoder = msgspec.msgpack.Encoder()


def encode_inputs(inputs: Inputs) -> bytes:
    r"""Write the inputs of a run as the bytes that `Sandbox` takes.

    Examples
    --------
    >>> encode_inputs(Inputs(objects=[], batches=[]))[:8]
    b'\x93\xa6inputs'
    """
    return _encoder.encode(inputs)


def pack(frame: Any) -> bytes:
    """Write a frame with its length in front."""
    body = _encoder.encode(frame)
    return HEADER.pack(len(body)) + body


def reply_bound(batch: Batch) -> int:
    """Give the largest honest reply to a batch, in bytes, plus a little slack."""
    cases = len(batch.cases)
    values = cases * batch.parts
    words = min(cases, MAX_REASONS) * (4 * MAX_REASON + 16) + 4 * cases
    return values * (8 * batch.max_elements + 2 + 8 * MAX_DIMENSIONS) + cases + words + 1024


reply_decoder: msgspec.msgpack.Decoder[Reply] = msgspec.msgpack.Decoder(Reply)
request_decoder: msgspec.msgpack.Decoder[Request] = msgspec.msgpack.Decoder(Request)


def decode(data: bytes | bytearray | memoryview, kind: type[_AnyFrame]) -> _AnyFrame:
    """Read one frame of a known kind; raises msgspec.DecodeError or ValidationError."""
    return msgspec.msgpack.decode(data, type=kind)
