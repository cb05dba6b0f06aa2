"""Shows that each limit ends what it is there to end: run by `doctor`, and worth running on a new machine."""

from __future__ import annotations

import time
from dataclasses import dataclass

from autograder.sandbox.channel import WALL_FACTOR
from autograder.sandbox.frames import Batch, Outcome, Source
from autograder.sandbox.host import Sandbox
from autograder.sandbox.outputs import Failure

_SLACK = 1.0  # seconds beyond the limit within which a child must be gone

# For each limit: what a submission does, and how it has to end.
_CASES = {
    "computing time": ("while True: pass", "timeout"),
    "waiting time": ("import time; time.sleep(1e6)", "timeout"),
    "memory": ("a = [0]\n    while True: a = a + a", "memory"),
    "output": ("while True: print('x' * 1000)", "output"),
    "processes": ("import os; return os.fork()", "refused"),
    "files": ("open('/dev/null')", "refused"),
}


@dataclass(frozen=True)
class Check:
    """One limit, whether it held, and the words that a student would read."""

    name: str
    held: bool
    message: str


def check_limits(sandbox: Sandbox) -> list[Check]:
    """Run a submission against every limit of a sandbox; takes about six times its time limit."""
    checks = []
    for name, (body, end) in _CASES.items():
        source = Source("module", [f"def f():\n    {body}\n"], "selftest")
        with sandbox.open(source) as session:
            session.load()
            begun = time.monotonic()
            outputs = session.call(Batch("f", 1, 1, [[]]))
            in_time = time.monotonic() - begun < WALL_FACTOR * sandbox.limits.cpu_seconds + _SLACK
        if isinstance(outputs, Failure):
            checks.append(Check(name, in_time and outputs.reason == end, outputs.message))
            continue
        message = outputs.reasons.get(0, "it went through")
        held = {
            "memory": outputs.outcome.tolist() == [Outcome.MEMORY],
            "refused": outputs.outcome.tolist() == [Outcome.RAISED] and message.startswith("PermissionError"),
        }.get(end, False)
        checks.append(Check(name, in_time and held, message))
    return checks
