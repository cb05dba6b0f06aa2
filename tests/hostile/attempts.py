"""Lets hostile specimens try everything in a place that is thrown away, with the locks on or off.

    python -m tests.hostile.attempts LOCKS CASE ...        LOCKS is "locked" or "unlocked"

For every case one line of JSON: its name, and which of its attempts got through. Run it through
`in_a_place_to_throw_away`, which gives it namespaces of its own where the machine has them.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from functools import cache
from pathlib import Path

import numpy as np

from autograder.sandbox.frames import Inputs, Source, encode_inputs
from autograder.sandbox.host import Limits, Sandbox
from tests.hostile import corpus

ROOT = Path(__file__).resolve().parents[2]
NOBODY = 65534
ALL_LOCKS = ("seccomp", "landlock", "rlimits")
_ENVIRONMENT = {
    "PATH": os.environ.get("PATH", "/usr/bin:/bin"),
    "HOME": "/var/tmp",
    "PYTHONPATH": os.pathsep.join([str(ROOT), str(Path(np.__file__).parents[1])]),
}
_SHARED_NOTHING = ("--mount", "--pid", "--ipc", "--net", "--uts", "--fork", "--kill-child")
# Inside the namespaces: a copy of all folders that takes what is written and is thrown away at the end.
_OWN_FOLDERS = """
set -e
mount -t tmpfs none /mnt
mkdir /mnt/upper /mnt/work /mnt/root
mount -t overlay none -o lowerdir=/,upperdir=/mnt/upper,workdir=/mnt/work /mnt/root
mount --rbind /dev /mnt/root/dev
for place in /tmp /var/tmp /dev/shm; do mount -t tmpfs none "/mnt/root$place"; done
mount -t proc none /mnt/root/proc
exec chroot /mnt/root "$@"
"""


def through(names: Sequence[str], locked: bool) -> dict[str, list[str]]:
    """Load the named cases and say which of their attempts got through."""
    wanted = [case for case in corpus.cases() if case.name in set(names)]
    found: dict[str, list[str]] = {}
    limits = Limits(cpu_seconds=0.5, memory_mib=128)
    without = () if locked else ALL_LOCKS
    with Sandbox(
        encode_inputs(Inputs(objects=[], batches=[])), limits, allow_unconfined=not locked, without=without
    ) as sandbox:
        for case in wanted:
            with sandbox.open(Source("module", [case.path.read_text("utf-8")], case.name)) as session:
                defined = session.load().functions
            found[case.name] = [name for name in case.attempts if f"won_{name}" in defined]
    return found


def in_a_place_to_throw_away(
    names: Sequence[str], *, locked: bool, ordinary: bool = False
) -> dict[str, list[str]] | None:
    """Do the same in a process of its own; None where there is no such place or no such user here.

    Without the locks this needs namespaces of its own: nobody else's processes, files or queues
    may be within reach of what runs there.
    """
    python = interpreter(ordinary)
    if python is None or (not locked and not has_namespaces()):
        return None
    command = [*python, "-m", "tests.hostile.attempts", "locked" if locked else "unlocked", *names]
    if not locked:
        command = ["unshare", *_SHARED_NOTHING, "sh", "-c", _OWN_FOLDERS, "sh", *command]
    run = subprocess.run(
        command,
        cwd="/",
        env=_ENVIRONMENT,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
        start_new_session=True,
    )
    assert run.returncode == 0, run.stderr[-2000:]
    return dict(map(json.loads, run.stdout.splitlines()))


def interpreter(ordinary: bool) -> list[str] | None:
    """Return the command that runs Python as this user or as nobody; None where there is none that both may run."""
    if not ordinary:
        return [sys.executable, "-B"]
    if os.geteuid() != 0 or shutil.which("setpriv") is None:
        return None
    drop = ["setpriv", f"--reuid={NOBODY}", f"--regid={NOBODY}", "--clear-groups", "--bounding-set=-all"]
    version = f"python{sys.version_info.major}.{sys.version_info.minor}"
    for python in (sys.executable, shutil.which(version, path="/usr/bin:/usr/local/bin:/bin")):
        if python and _runs([*drop, "sh", "-c", 'exec "$0" "$@"', python, "-B"]):
            return [*drop, "sh", "-c", 'exec "$0" "$@"', python, "-B"]
    return None


def _runs(command: list[str]) -> bool:
    script = "import tests.hostile.attempts, subprocess, sys; subprocess.run([sys.executable, '-c', ''], check=True)"
    run = subprocess.run([*command, "-c", script], cwd="/", env=_ENVIRONMENT, capture_output=True, check=False)
    return run.returncode == 0


@cache
def has_namespaces() -> bool:
    """Tell whether this user may make namespaces of its own, and this checkout can be reached in them."""
    if shutil.which("unshare") is None:
        return False
    return _runs(["unshare", *_SHARED_NOTHING, "sh", "-c", _OWN_FOLDERS, "sh", sys.executable, "-B"])


def main(locks: str, names: Sequence[str]) -> None:
    """Print a line for every case."""
    os.chdir("/")
    for name, won in through(names, locks == "locked").items():
        print(json.dumps([name, won]))


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
