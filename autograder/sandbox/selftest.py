"""Shows that each limit ends what it is there to end: run by `doctor`, and worth running on a new machine."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from autograder.sandbox.channel import WALL_FACTOR
from autograder.sandbox.frames import Batch, Outcome, Source
from autograder.sandbox.host import Sandbox
from autograder.sandbox.outputs import Failure
from autograder.sandbox.server import Limits
from autograder.sandbox.session import Session

_SLACK = 1.0  # seconds beyond the limit within which a child must be gone

End = Literal["timeout", "memory", "output", "refused"]


@dataclass(frozen=True)
class _Case:
    """What a submission does against one limit, and how that has to end."""

    name: str
    attempt: str
    body: str
    end: End


_CASES = (
    _Case("computing time", "an endless loop", "while True: pass", "timeout"),
    _Case("waiting time", "an endless sleep", "import time; time.sleep(1e6)", "timeout"),
    _Case("memory", "a memory bomb", "a = [0]\n    while True: a = a + a", "memory"),
    _Case("output", "an output flood", "while True: print('x' * 1000)", "output"),
    _Case("processes", "starting a process", "import os; return os.fork()", "refused"),
    _Case("files", "opening a file", "open('/dev/null')", "refused"),
)


@dataclass(frozen=True)
class Check:
    """One limit, whether it held, and the words that a student would read.

    Parameters
    ----------
    name : str
        What is limited.
    held : bool
        Whether the attempt ended for this reason, at most a second beyond the limit.
    message : str
        What a student would read; where it did not hold, what happened.
    limit : str
        How much is allowed.
    attempt : str
        What was tried.
    seconds : float
        What it took until the attempt was over: computing for computing time, else by the clock [s].
    """

    name: str
    held: bool
    message: str
    limit: str
    attempt: str
    seconds: float


def check_limits(sandbox: Sandbox) -> Iterator[Check]:
    """Run a submission against every limit of a sandbox, one after the other.

    It takes about four times the time limit of the sandbox.
    """
    for case in _CASES:
        source = Source("module", [f"def f():\n    {case.body}\n"], "selftest")
        with sandbox.open(source) as session:
            session.load()
            yield _check(session, case, sandbox.limits)


def _check(session: Session, case: _Case, limits: Limits) -> Check:
    cpu, begun = session.left.cpu, time.monotonic()
    outputs = session.call(Batch("f", 1, 1, [[]]))
    waited, computed = time.monotonic() - begun, cpu - session.left.cpu
    waiting = WALL_FACTOR * limits.cpu_seconds
    seconds, most = (computed, limits.cpu_seconds) if case.name == "computing time" else (waited, waiting)
    allowed = {
        "computing time": f"{limits.cpu_seconds:g} s",
        "waiting time": f"{waiting:g} s",
        "memory": f"{limits.memory_mib} MiB",
        "output": f"{limits.output_bytes / 2**20:g} MiB",
    }.get(case.name, "none")
    if isinstance(outputs, Failure):
        held, message = outputs.reason == case.end, outputs.message
    else:
        outcome, said = outputs.outcome.tolist(), outputs.reasons.get(0, "")
        message = said or "it went through"
        held = case.end == "refused" and outcome == [Outcome.RAISED] and said.startswith("PermissionError")
        if case.end == "memory" and outcome == [Outcome.MEMORY]:
            held, message = True, f"it needed more than {limits.memory_mib} MiB of memory"
    if held and seconds > most + _SLACK:
        held, message = False, f"it ended only after {seconds:.1f} s: {message}"
    return Check(case.name, held, message, allowed, case.attempt, round(seconds, 3))
