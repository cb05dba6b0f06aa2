"""Run a command, end it in some way at some moment, and print what of it still runs: `left_over.py HOW WORDS...`.

This process inherits whatever loses its parent, so that nothing gets away unseen.
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

PR_SET_CHILD_SUBREAPER = 36
GRACE = 3.0  # seconds for processes whose parent was killed and could not wait for them


def family(pid: int) -> list[int]:
    """Return the processes below one that run: the dead that wait to be counted are none."""
    found = []
    try:
        text = Path(f"/proc/{pid}/task/{pid}/children").read_text()
    except OSError:
        return []
    for child in map(int, text.split()):
        try:
            state = Path(f"/proc/{child}/stat").read_text().rpartition(")")[2].split()[0]
        except OSError:
            continue
        found += [*([child] if state not in "ZX" else []), *family(child)]
    return found


def main(how: str, words: list[str]) -> dict[str, object]:
    """Run, disturb, look."""
    ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
    with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as command:
        most = 0
        if how != "none":
            until = time.monotonic() + 30
            while command.poll() is None and time.monotonic() < until and len(family(command.pid)) < 3:
                time.sleep(0.01)
            time.sleep(0.3)
            most = len(family(command.pid))
            command.send_signal(signal.Signals[how])
        while command.poll() is None:
            most = max(most, len(family(command.pid)))
            time.sleep(0.005)
        left = family(os.getpid())
        if how == "SIGKILL":
            until = time.monotonic() + GRACE
            while left and time.monotonic() < until:
                time.sleep(0.02)
                left = family(os.getpid())
        names = [Path(f"/proc/{pid}/cmdline").read_bytes().decode()[-60:] for pid in left if _alive(pid)]
        for pid in left:
            os.kill(pid, signal.SIGKILL)
        said = command.stderr.read() if command.stderr else ""
    return {"code": command.returncode, "most": most, "left": names, "said": said}


def _alive(pid: int) -> bool:
    return Path(f"/proc/{pid}/cmdline").exists()


if __name__ == "__main__":
    print(json.dumps(main(sys.argv[1], sys.argv[2:])))
