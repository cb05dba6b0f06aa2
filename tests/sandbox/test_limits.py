"""What takes too long, too much or dies ends its own call only, and the words say which limit it was."""

from __future__ import annotations

import time
from collections.abc import Callable

import pytest

from autograder.sandbox.frames import Outcome, Source
from autograder.sandbox.host import Failure, Limits, Outputs, Sandbox
from tests.sandbox.conftest import batch, inputs

Run = Callable[..., Outputs | Failure]

DEAF = """
    while True:
        try:
            while True: pass
        except BaseException: pass
"""
ENDINGS = {
    "an endless loop": ("while True: pass", "timeout", "0.25 s of computing"),
    "a deaf loop": (DEAF, "timeout", "0.25 s of computing"),
    "one long operation": ("return 10**10**9", "timeout", "0.25 s of computing"),
    "a long search": ("import re; return re.match('(a+)+$', 'a' * 50 + 'b')", "timeout", "0.25 s of computing"),
    "endless algebra": ("import numpy as np\n    while True: np.linalg.svd(np.eye(50))", "timeout", "of computing"),
    "a long sleep": ("import time; time.sleep(1e9)", "timeout", "0.75 s of waiting"),
    "leaving at once": ("import os; os._exit(3)", "died", "it ended the Python process (exit status 3)"),
    "an abort": ("import os; os.abort()", "died", "it crashed the Python interpreter (SIG"),
    "a null pointer": ("import sys; sys.modules['ctypes'].string_at(0)", "died", "it crashed the Python interp"),
    "a flood": ("while True: print('\\0\\x1b[31m' * 1000)", "output", "it printed more than 1 MiB"),
    "a raw flood": ("import os\n    while True: os.write(2, b'\\xff' * 10000)", "output", "it printed more than 1 MiB"),
    "an error that never ends": ("raise Slow", "timeout", "of computing"),
}  # fmt: skip  # a table
BEFORE = """
class Slow(Exception):
    def __str__(self):
        while True: pass
"""


@pytest.mark.parametrize(("body", "reason", "words"), ENDINGS.values(), ids=ENDINGS.keys())
def test_a_call_that_does_not_come_back(sandbox: Sandbox, body: str, reason: str, words: str) -> None:
    """It is ended in time, named, and the next function of the same submission runs in a fresh child."""
    text = f"{BEFORE}\ndef f(x, graph):\n    {body}\ndef g(x, graph):\n    return x\n"
    with sandbox.open(Source("module", [text], "student")) as session:
        session.load()
        begun = time.monotonic()
        failure = session.call(batch("f"))
        assert time.monotonic() - begun < 3
        assert isinstance(failure, Failure)
        assert failure.reason == reason
        assert words in failure.message
        assert isinstance(session.call(batch("g")), Outputs)


def test_memory_is_limited_in_total(run: Run) -> None:
    """A list that grows for ever ends in MemoryError, not in a slow machine."""
    outputs = run("def f(x, graph):\n    a = [0]\n    while True:\n        a = a + a\n", cases=2)
    assert isinstance(outputs, Outputs), outputs
    assert outputs.outcome.tolist() == [Outcome.MEMORY] * 2


def test_memory_that_is_kept_costs_its_own_call(sandbox: Sandbox) -> None:
    """Where all memory stays used up the failure is memory, and the next function has it back."""
    text = """
kept = []
def f(x, graph):
    size = 1 << 24
    while size > 64:
        try:
            while True:
                kept.append(bytearray(size))
        except MemoryError:
            size //= 2
    raise MemoryError
def g(x, graph):
    return bytes(1 << 25)[:0] and x or x
"""
    with sandbox.open(Source("module", [text], "student")) as session:
        ended = session.call(batch("f", cases=2))
        assert (
            ended.reason == "memory" if isinstance(ended, Failure) else ended.outcome.tolist() == [Outcome.MEMORY] * 2
        )
        session.fresh()
        assert isinstance(session.call(batch("g")), Outputs)


def test_a_submission_has_a_total(sandbox: Sandbox) -> None:
    """After four times the limit the rest of the submission is not run."""
    with sandbox.open(Source("module", ["def f(x, g):\n    while True: pass\n"], "student")) as session:
        failures = [session.call(batch()) for _ in range(6)]
    reasons = [failure.reason for failure in failures if isinstance(failure, Failure)]
    assert reasons[:3] == ["timeout"] * 3
    assert reasons[-1] == "budget"
    assert len(reasons) == 6


def test_the_total_holds_while_loading(sandbox: Sandbox) -> None:
    """Statements that hang one after the other end in the same total."""
    text = "def f(x, g): return x\n" + "while True: pass\n" * 9
    begun = time.monotonic()
    with sandbox.open(Source("module", [text], "student")) as session:
        loaded = session.load()
        failure = session.call(batch())
    assert time.monotonic() - begun < 4
    assert 3 <= len(loaded.notes) <= 5
    assert {note.status for note in loaded.notes} == {"timeout"}
    assert isinstance(failure, Failure)
    assert failure.reason == "budget"


def test_waiting_has_a_total_too(sandbox: Sandbox) -> None:
    """Sleeping costs no computing, and still does not go on for ever."""
    begun = time.monotonic()
    with sandbox.open(Source("module", ["import time\n" + "time.sleep(9)\n" * 9], "student")) as session:
        session.load()
    assert time.monotonic() - begun < 5


def test_printing_within_the_limit_costs_nothing(run: Run) -> None:
    """Output below the limit is drained and thrown away, however it is written."""
    lines = ["print('x' * 300_000)", "print('\\ud800', file=sys.stderr, flush=True)", "return x"]
    text = "import sys\ndef f(x, graph):\n    " + "\n    ".join(lines)
    outputs = run(text, cases=2)
    assert isinstance(outputs, Outputs), outputs
    assert outputs.outcome.tolist() == [Outcome.OK] * 2


def test_messages_hold_no_measured_time() -> None:
    """Two runs of the same endless loop say the same, to the letter."""
    limits = Limits(cpu_seconds=0.05)
    said = set()
    with Sandbox(inputs(), limits) as sandbox:
        for _ in range(2):
            with sandbox.open(Source("module", ["def f(x, g):\n    while True: pass\n"], "student")) as session:
                said.add(session.call(batch()))
    assert said == {Failure("timeout", "it took longer than 0.05 s of computing, or 0.15 s of waiting")}


def test_a_large_reply_arrives_whole(run: Run) -> None:
    """A batch of many megabytes comes back complete."""
    text = "import numpy as np\ndef f(x, graph):\n    return np.arange(100_000.0)\n"
    outputs = run(text, cases=20, most=100_000)
    assert isinstance(outputs, Outputs), outputs
    assert outputs.data.size == 2_000_000
    assert outputs.data[-1] == 99_999
