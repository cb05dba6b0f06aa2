"""Throws frames at the grader's end of the channel: a million by default, from a seed that is printed.

    python tests/fuzz/frames.py --frames 1000000 --seed 0

A frame may be read or refused. Anything else, an exception of another kind or memory beyond the
bound, is a failure, and the frame is printed.
"""

from __future__ import annotations

import argparse
import random
import resource
import socket
import sys
import time
import tracemalloc
from os import pipe
from pathlib import Path
from typing import Any

import msgspec

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from autograder.sandbox import frames
from autograder.sandbox.channel import Budget, Channel, Ended
from autograder.sandbox.outputs import Expected, Violation, read_answers, read_outputs

EXPECTED = Expected(cases=3, parts=1, most=4, bound=4096)
_ODD = [
    0,
    1,
    2,
    3,
    4,
    7,
    16,
    17,
    63,
    64,
    127,
    128,
    255,
    256,
    2**31,
    2**32 - 1,
    2**62,
    2**63,
    2**64 - 1,
    -1,
    -5,
    -(2**63),
]
_SIDES = (2).to_bytes(8, "little") * 3
GOOD: list[list[Any]] = [
    ["results", 1, bytes(3), bytes(3), b"\1\1\1", _SIDES, bytes(48), {}, -1],
    ["results", 1, b"\1\0\0", bytes(3), b"\0\1\1", _SIDES[:16], bytes(32), {"ValueError: x": bytes(4)}, 2],
    ["loaded", 1, ["f", "g"], [["remark", 0, 3, "error", "x"]], ["answers", [2, 2], bytes(32), "a", None, "text", ""]],
    ["progress", 1, 0, 3, 12],
    ["hello", 0],
    ["trouble", 1, "memory"],
    ["probed", 1, ["fork"]],
]


def value(draw: random.Random, depth: int = 0) -> Any:
    """Draw a value that msgpack can hold, now and then a deep or a large one."""
    kind = draw.randrange(10)
    if kind < 3:
        return draw.choice(_ODD)
    if kind == 3:
        return draw.randbytes(draw.choice((0, 1, 3, 8, 48, 500)))
    if kind == 4:
        return "".join(
            map(chr, draw.choices((0, 10, 27, 65, 0xE4, 0x202E, 0x1F600), k=draw.choice((0, 1, 5, 70, 301))))
        )
    if kind == 5:
        return draw.choice((None, True, False, 0.5, float("nan"), float("inf")))
    if kind == 6 and depth < 4:
        return {draw.choice(_ODD): value(draw, depth + 1) for _ in range(draw.randrange(4))}
    if depth < 4:
        return [value(draw, depth + 1) for _ in range(draw.randrange(5))]
    return []


def frame(draw: random.Random) -> bytes:
    """Draw a frame: a good one with a field or some bytes changed, cut, repeated, or nothing but noise."""
    data = list(draw.choice(GOOD))
    for _ in range(draw.randrange(3)):
        data[draw.randrange(len(data))] = value(draw)
    if draw.random() < 0.1:
        data.append(value(draw))
    encoded = bytearray(msgspec.msgpack.encode(data))
    how = draw.randrange(6)
    if how == 0:
        for _ in range(draw.randrange(1, 4)):
            encoded[draw.randrange(len(encoded))] = draw.randrange(256)
    elif how == 1:
        del encoded[draw.randrange(len(encoded)) :]
    elif how == 2:
        at = draw.randrange(len(encoded))
        encoded[at:at] = draw.choice(
            (b"\xdd\xff\xff\xff\xff", b"\xdf\xff\xff\xff\xff", b"\xc6\xff\xff\xff\xff", b"\x91" * 400)
        )
    elif how == 3 and draw.random() < 0.2:
        encoded = bytearray(draw.randbytes(draw.randrange(100)))
    return bytes(encoded)


def read(data: bytes) -> str:
    """Do with one frame what the grader does; give what became of it."""
    try:
        reply = frames.reply_decoder.decode(data)
    except (msgspec.MsgspecError, ValueError, OverflowError, RecursionError):
        return "refused"
    try:
        if isinstance(reply, frames.BatchReport):
            read_outputs(reply, EXPECTED)
        elif isinstance(reply, frames.LoadReport):
            read_answers(reply.answers)
    except Violation:
        return "violation"
    return "read"


def through_a_channel(draw: random.Random) -> str:
    """Send a stream of frames, lengths included or wrong, in pieces through a real socket."""
    ours, theirs = socket.socketpair()
    reading, writing = pipe()
    channel = Channel(ours, reading, 1000, Budget(0.05, 0.05))
    with theirs, open(writing, "wb"):
        body = frame(draw)
        length = len(body) if draw.random() < 0.8 else draw.choice((0, 1, len(body) + 1, 4096, 4097, 2**32 - 1))
        theirs.sendall(length.to_bytes(4, "little") + body + draw.choice((b"", b"", b"x")))
        theirs.shutdown(socket.SHUT_WR)
        try:
            channel.begin(b"", 1)
            channel.reply(EXPECTED.bound, 0.01)
            try:
                channel.require_silence()
            except Ended as end:
                return "read" if end.reason == "died" else end.reason  # the other end is closed by now
        except Ended as end:
            return end.reason
        finally:
            channel.close()
    return "never"


def fuzz(count: int, seed: int, streams: int) -> dict[str, int]:
    """Read `count` frames and `streams` streams; raises what the grader should never raise."""
    draw = random.Random(seed)
    became: dict[str, int] = {}
    for number in range(count):
        data = frame(draw)
        watched = number % 50 == 0  # watching memory makes a frame many times slower
        if watched:
            tracemalloc.start()
        try:
            end = read(data)
        except BaseException:
            print(f"seed {seed}, frame {number}: {data!r}", file=sys.stderr)
            raise
        if watched:
            _, peak = tracemalloc.get_traced_memory()
            tracemalloc.stop()
            if peak > 100_000 + 20 * len(data):
                raise MemoryError(f"seed {seed}, frame {number}: {peak} bytes for {data!r}")
        became[end] = became.get(end, 0) + 1
    for _ in range(streams):
        end = "stream " + through_a_channel(draw)
        became[end] = became.get(end, 0) + 1
    return became


def main() -> None:
    """Fuzz from the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--frames", type=int, default=1_000_000)
    parser.add_argument("--streams", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=time.time_ns() % 2**32)
    chosen = parser.parse_args()
    print(f"seed {chosen.seed}")
    begun = time.monotonic()
    became = fuzz(chosen.frames, chosen.seed, chosen.streams)
    seconds = time.monotonic() - begun
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(", ".join(f"{count} {end}" for end, count in sorted(became.items())))
    print(
        f"{chosen.frames + chosen.streams} in {seconds:.0f} s, peak memory {peak:.0f} MiB, nothing but our own refusals"
    )


if __name__ == "__main__":
    main()
