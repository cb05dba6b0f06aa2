"""The channel is the child's only way out: forged, broken or late bytes on it gain nothing."""

from __future__ import annotations

import time

import pytest

from autograder.sandbox.frames import Source
from autograder.sandbox.host import Failure, Outputs, Sandbox
from tests.sandbox.conftest import X, batch

# What a hostile submission has at hand in its own process: the frames of the child, and the channel.
BEFORE = """
import os, sys
def frames():
    at = sys._getframe()
    while at:
        yield at
        at = at.f_back
def asked():
    return next(frame.f_locals["request"] for frame in frames() if "request" in frame.f_locals)
def lend(name):
    return sys.modules["sandbox." + name]
def forge(nonce):
    f = lend("frames")
    return f.pack(f.BatchReport(nonce, b"\\0", b"\\0", b"\\x01", (3).to_bytes(8, "little"), bytes(24), {}, -1))
"""
VIOLATIONS = {
    "garbage": "os.write(3, b'\\xff' * 1000)",
    "a flood of garbage": "while True: os.write(3, os.urandom(1000) if 0 else b'x' * 100_000)",
    "a header of four gigabytes": "os.write(3, b'\\xff\\xff\\xff\\xff')",
    "a frame without a nonce": "os.write(3, forge(0))",
    "a frame of another nonce": "os.write(3, forge(12345))",
    "a pickle": "os.write(3, (20).to_bytes(4, 'little') + b'\\x80\\x04cos\\nsystem\\n(tR.'.ljust(20))",
    "an empty frame": "os.write(3, bytes(4))",
    "deep nesting": "os.write(3, (2000).to_bytes(4, 'little') + b'\\x91' * 2000)",
    "a reply before its request": "os.write(3, forge(asked().nonce)); return x",
    "a reply of another kind": "f = lend('frames'); os.write(3, f.pack(f.Progress(asked().nonce, 0, 0, 0)))",
    "a greeting": "f = lend('frames'); os.write(3, f.pack(f.Hello(asked().nonce)))",
    "a tail": "os.write(3, forge(asked().nonce) + b'more')",
}


@pytest.mark.parametrize("body", VIOLATIONS.values(), ids=VIOLATIONS.keys())
def test_a_child_that_writes_to_the_channel_is_ended(sandbox: Sandbox, body: str) -> None:
    """The first byte out of place ends the child; the next submission is none the wiser."""
    text = (
        f"{BEFORE}\ndef f(x, graph):\n    {body}\n    os.write(3, b'x')\n    os._exit(0)\ndef g(x, graph): return x\n"
    )
    with sandbox.open(Source("module", [text], "student")) as session:
        session.load()
        failure = session.call(batch("f"))
        if isinstance(failure, Outputs):  # a forged reply that arrived before the tail is one value, as if returned
            failure = session.call(batch("g"))
        assert isinstance(failure, Failure)
        assert failure.reason in {"violation", "died"}
        assert isinstance(session.call(batch("g")), Outputs)
    with sandbox.open(Source("module", ["def f(x, graph): return x\n"], "other")) as session:
        assert isinstance(session.call(batch("f")), Outputs)


def test_a_forged_frame_is_a_returned_value(sandbox: Sandbox) -> None:
    """Who forges the reply to the very request has returned that value, and no more: it holds no marks."""
    text = f"{BEFORE}\ndef f(x, graph):\n    os.write(3, forge(asked().nonce))\n    while True: pass\n"
    with sandbox.open(Source("module", [text], "student")) as session:
        outputs = session.call(batch("f"))
    assert isinstance(outputs, Outputs)
    assert outputs.data.tolist() == [0, 0, 0]


def test_a_reply_kept_for_later_is_refused(sandbox: Sandbox) -> None:
    """Frames that are sent ahead, for requests to come, are bytes that nobody asked for."""
    forged = "forge(asked().nonce) + forge(asked().nonce + 1)"
    text = f"{BEFORE}\ndef f(x, graph):\n    os.write(3, {forged})\n    while True: pass\n"
    with sandbox.open(Source("module", [text], "student")) as session:
        failure = session.call(batch("f"))
    assert isinstance(failure, Failure)
    assert failure.reason == "violation"


def test_a_frame_that_trickles_is_ended(sandbox: Sandbox) -> None:
    """One byte every so often does not stretch the deadline of a frame."""
    loop = "    for byte in forge(asked().nonce):\n        os.write(3, bytes([byte]))\n        time.sleep(0.05)\n"
    text = f"{BEFORE}\nimport time\ndef f(x, graph):\n{loop}"
    begun = time.monotonic()
    with sandbox.open(Source("module", [text], "student")) as session:
        failure = session.call(batch("f"))
    assert isinstance(failure, Failure)
    assert failure.reason == "timeout"
    assert time.monotonic() - begun < 2


def test_a_child_that_never_reads_does_not_block(sandbox: Sandbox) -> None:
    """A request larger than every buffer waits for the limit, not for ever."""
    text = f"{BEFORE}\nimport time\ndef f(x, graph):\n    os.write(3, forge(asked().nonce))\n    time.sleep(60)\n"
    with sandbox.open(Source("module", [text], "student")) as session:
        assert isinstance(session.call(batch("f")), Outputs)
        begun = time.monotonic()
        failure = session.call(batch("f", cases=100_000, arguments=[X, X]))
        assert time.monotonic() - begun < 3
    assert isinstance(failure, Failure)
    assert failure.reason == "timeout"


def test_statements_reported_out_of_order_are_refused(sandbox: Sandbox) -> None:
    """A flood of progress does not stretch the limit of a statement."""
    flood = "while True: os.write(3, f.pack(f.Progress(asked().nonce, 0, 0, 0)))"
    text = f"{BEFORE}\nf = lend('frames')\n{flood}\ndef g(): pass\n"
    with sandbox.open(Source("module", [text], "student")) as session:
        loaded = session.load()
    assert "g" in loaded.functions
    assert any("own channel" in note.message for note in loaded.notes)


def test_there_is_nothing_to_find(sandbox: Sandbox) -> None:
    """A submission that walks its frames, its heap and its modules finds inputs, and no other text or value."""
    first = "MARK" + "ER_OF_ANOTHER = 'secret' * 3\ndef f(x, graph): return x\n"
    with sandbox.open(Source("module", [first], "student")) as session:
        session.load()
    text = """
import sys
gc = sys.modules["gc"]
def f(x, graph):
    texts = [value for value in gc.get_objects() if isinstance(value, (str, bytes))]
    for holder in gc.get_objects():
        if isinstance(holder, dict):
            texts += [value for pair in list(holder.items()) for value in pair if isinstance(value, (str, bytes))]
    known = [name for name in sys.modules if name.startswith(("autograder", "reference", "hypothesis"))]
    hits = [text for text in texts if "MARK" + "ER_OF" in str(text) and "texts = [" not in str(text)]
    return [len(hits), len(known), len(sys.modules["os"].environ), len(sys.argv) - 1, len(sys.path)]
"""
    with sandbox.open(Source("module", [text], "other")) as session:
        outputs = session.call(batch("f"))
    assert isinstance(outputs, Outputs)
    assert outputs.data.tolist() == [0, 0, 0, 0, 0], outputs.reasons
