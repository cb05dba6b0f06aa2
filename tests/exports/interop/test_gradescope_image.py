"""The real setup.sh and a run inside Gradescope's default limits: 768 MB, half a CPU, well inside ten minutes."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import jsonschema
import pytest

from reference_solution import slam1d
from tests.exports.gradescope_layout import hand_in, run_autograder, unpack
from tests.exports.interop.conftest import run
from tests.exports.test_gradescope_results import SCHEMA

MEMORY = 768_000_000  # bytes
SECONDS = 600.0
REFERENCE = Path(slam1d.__file__).read_bytes()
# Holds as much as it is let, for a while: what is measured is the most that a submission can make of the machine.
GREEDY = b"""
import time
held = []
try:
    while True:
        held.append(bytearray(8 << 20))
        held[-1][::4096] = b"x" * len(held[-1][::4096])
except MemoryError:
    time.sleep(1)
"""


@pytest.fixture(scope="module")
def image(tmp_path_factory: pytest.TempPathFactory, grader: Callable[..., None]) -> Path:
    """Export with default settings, and let setup.sh build the environment from the locked versions."""
    place = tmp_path_factory.mktemp("image")
    grader("export", "gradescope", "-o", place / "autograder.zip")
    root = unpack(place / "autograder.zip", place / "autograder")
    began = time.monotonic()
    paths = {**os.environ, "AUTOGRADER_ROOT": str(root), "AUTOGRADER_PYTHON": sys.executable}
    subprocess.run(["bash", root / "source" / "setup.sh"], cwd=root, env=paths, check=True, stdin=subprocess.DEVNULL)
    size = (place / "autograder.zip").stat().st_size / 1000
    print(f"\narchive {size:.0f} kB, setup.sh {time.monotonic() - began:.0f} s")
    return root


def used(root: int) -> int:
    """Add up what a process and everything below it hold, shared pages shared out [bytes]."""
    children: dict[int, list[int]] = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        children.setdefault(int(fields[1]), []).append(int(stat.parent.name))
    total, queue = 0, [root]
    while queue:
        process = queue.pop()
        queue += children.get(process, [])
        try:
            lines = Path(f"/proc/{process}/smaps_rollup").read_text().splitlines()
        except OSError:
            continue
        total += sum(int(line.split()[1]) * 1024 for line in lines if line.startswith("Pss:"))
    return total


@contextmanager
def watched() -> Iterator[list[int]]:
    """Watch what everything below this process holds, but not this process itself."""
    most, over = [0], threading.Event()

    def watch() -> None:
        while not over.wait(0.05):
            mine = Path("/proc/self/smaps_rollup").read_text().split("Pss:")[1].split()[0]
            most[0] = max(most[0], used(os.getpid()) - int(mine) * 1024)

    thread = threading.Thread(target=watch)
    thread.start()
    try:
        yield most
    finally:
        over.set()
        thread.join()


@contextmanager
def half_a_cpu() -> Iterator[None]:
    """Keep everything that starts here on one core, and keep that core busy with somebody else's work."""
    cores = os.sched_getaffinity(0)
    core = min(cores)
    os.sched_setaffinity(0, {core})
    busy = subprocess.Popen([sys.executable, "-c", "while True: pass"])
    try:
        yield
    finally:
        busy.kill()
        busy.wait()
        os.sched_setaffinity(0, cores)


def test_setup_installs_the_locked_versions(image: Path) -> None:
    """What runs is what is locked, and nothing that only development needs."""
    listed = run([image / "source" / "environment" / "bin" / "python", "-m", "pip", "list", "--format", "json"], image)
    installed = {each["name"].lower(): each["version"] for each in json.loads(listed)}
    locked = (image / "source" / "requirements.txt").read_text(encoding="utf-8")
    assert f"hypothesis=={installed['hypothesis']}" in locked
    assert f"numpy=={installed['numpy']}" in locked
    assert not {"pytest", "ruff", "mypy"} & set(installed)


@pytest.mark.parametrize(("name", "text", "score"), [("reference", REFERENCE, 100.0), ("greedy", GREEDY, 0.0)])
def test_a_run_stays_inside_the_limits(image: Path, name: str, text: bytes, score: float) -> None:
    """With half a CPU the default settings take seconds, and the most that is held is below 768 MB."""
    hand_in(image, {"slam1d.py": text})
    began = time.monotonic()
    with half_a_cpu(), watched() as most:
        found, said = run_autograder(image)
    seconds = time.monotonic() - began
    print(f"\n{name}: {seconds:.1f} s on half a CPU, at most {most[0] / 1e6:.0f} MB, score {found['score']}")
    jsonschema.validate(found, SCHEMA)
    assert said == ""
    assert found["score"] == score
    assert most[0] < MEMORY
    assert seconds < SECONDS / 5
