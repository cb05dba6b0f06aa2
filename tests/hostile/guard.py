"""Runs one command as its child, watches it from outside, and says as JSON what it did and what it left.

    python guard.py REPORT MODE COMMAND ...

MODE is "watch", or "kill": then the command is killed as soon as a submission computes in a child
of one of its fork servers, and what counts is how soon everything below it is gone.

As the reaper of all that the command leaves behind, it sees processes that outlive it. It counts
signals that reach it, and follows the memory of the command and of its workers.
"""

from __future__ import annotations

import ctypes
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

_SET_CHILD_SUBREAPER = 36
_WATCHED = (signal.SIGTERM, signal.SIGHUP, signal.SIGUSR1, signal.SIGUSR2, signal.SIGWINCH, signal.SIGURG)
_GRACE = 10.0  # seconds to wait for what a command leaves behind, before it is killed and counted
_BELOW = 3  # generations from the command to a submission: worker, fork server, child


def main(report: str, mode: str, command: list[str]) -> None:
    """Run the command and write the report."""
    signals: list[int] = []
    for number in _WATCHED:
        signal.signal(number, lambda got, _: signals.append(got))
    ctypes.CDLL(None).prctl(_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
    before = dict(os.environ)
    began = time.monotonic()
    process = subprocess.Popen(command)
    peak = 0
    while process.poll() is None:
        peak = max(peak, *(_peak(pid) for pid in [process.pid, *_children(process.pid)]))
        time.sleep(0.05)
        if mode == "kill" and _computes(process.pid):
            process.kill()
    seconds = time.monotonic() - began
    left = _orphans()
    after = time.monotonic() - began - seconds
    times = os.times()
    Path(report).write_text(
        json.dumps(
            {
                "code": process.returncode,
                "seconds": seconds,
                "cpu_seconds": times.children_user + times.children_system,
                "seconds_after": after,
                "peak_kib": peak,
                "processes_left": left,
                "signals": signals,
                "environment_changed": dict(os.environ) != before,
            }
        )
    )


def _children(pid: int) -> list[int]:
    """Name the children of a process: of the grader these are its workers."""
    try:
        return [int(child) for child in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]
    except OSError:
        return []


def _computes(pid: int) -> bool:
    """Tell whether a submission is running below a grader, for a while already."""
    generation = [pid]
    for _ in range(_BELOW):
        generation = [child for parent in generation for child in _children(parent)]
    return any(_age(child) > 0.2 for child in generation)


def _age(pid: int) -> float:
    """Return for how long a process has lived [s]; 0 where it is gone."""
    try:
        started = int(Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[19])
    except OSError:
        return 0.0
    return time.clock_gettime(time.CLOCK_BOOTTIME) - started / os.sysconf("SC_CLK_TCK")


def _peak(pid: int) -> int:
    """Return the largest size that a process has had [KiB], 0 where it is gone."""
    try:
        lines = Path(f"/proc/{pid}/status").read_text().splitlines()
    except OSError:
        return 0
    return next((int(line.split()[1]) for line in lines if line.startswith("VmHWM")), 0)


def _orphans() -> int:
    """Wait for what the command left to end; kill what does not, and count it."""
    end = time.monotonic() + _GRACE
    while time.monotonic() < end:
        try:
            if os.waitpid(-1, os.WNOHANG) == (0, 0):
                time.sleep(0.02)
        except ChildProcessError:
            return 0
    left = _children(os.getpid())
    for pid in left:  # these are children of this very process
        os.kill(pid, signal.SIGKILL)
        os.waitpid(pid, 0)
    return len(left)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], sys.argv[3:])
