"""Kill -9 at random points: nothing is lost, and the resumed run ends with the bytes of an undisturbed one.

A round is one output folder: its run is killed at, resumed, killed at again, and in the end left
alone. Nine rounds make fifty-four kills; `make crashes` prints the table.
"""

from __future__ import annotations

import os
import random
import signal
import subprocess
import time
from pathlib import Path

import pytest

from tests.engine.small_class import CLASS, agreed, command, make

ROUNDS = int(os.environ.get("CRASH_ROUNDS", "9"))
TARGETS = ("worker", "fork server", "grader", "worker", "fork server", "grader")  # of one round, in some order
pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the class."""
    return make(tmp_path_factory.mktemp("crashes"))


@pytest.fixture(scope="module")
def calm(course: Path) -> tuple[dict[str, bytes], float]:
    """What an undisturbed run leaves, and the seconds that it takes."""
    began = time.monotonic()
    subprocess.run(command(course, course / "calm", "--workers", "2"), check=True, capture_output=True)
    return agreed(course / "calm"), time.monotonic() - began


def children(pid: int) -> list[int]:
    """Return the processes that a process has started and that live."""
    try:
        return [int(each) for each in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]
    except OSError:
        return []


def _is(pid: int, word: bytes) -> bool:
    try:
        return word in Path(f"/proc/{pid}/cmdline").read_bytes()
    except OSError:
        return False


def _find(grader: int, target: str) -> list[int]:
    workers = [pid for pid in children(grader) if _is(pid, b"spawn_main")]
    if target == "grader":
        return [grader]
    if target == "worker":
        return workers
    return [pid for each in workers for pid in children(each) if _is(pid, b"forkserver.py")]


def _kill_one(grader: subprocess.Popen[str], target: str, choice: random.Random) -> bool:
    """Kill one process of a kind; False where the run ended before there was one."""
    while grader.poll() is None:
        found = _find(grader.pid, target)
        if found:
            try:
                os.kill(choice.choice(found), signal.SIGKILL)
            except ProcessLookupError:
                continue
            return True
        time.sleep(0.01)
    return False


def _disturb(course: Path, out: Path, seconds: float, choice: random.Random) -> tuple[int, int]:
    """Run until all kills are done and a run has ended by itself; return the kills and the starts.

    A run that ends before all kills are done is followed by one that grades everything again.
    """
    waiting = choice.sample(TARGETS, len(TARGETS))
    kills, starts, ended = 0, 0, False
    while not ended or waiting:
        starts += 1
        again = ["--fresh"] if ended else []
        words = command(course, out, "--workers", "2", *again)
        grader = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        while grader.poll() is None and waiting:
            try:
                grader.wait(choice.random() * 0.7 * seconds)
            except subprocess.TimeoutExpired:
                if _kill_one(grader, waiting[-1], choice):
                    waiting.pop()
                    kills += 1
        _, said = grader.communicate()
        assert "Traceback" not in said or grader.returncode == -signal.SIGKILL, said
        assert grader.returncode in {0, 3, -signal.SIGKILL}, said
        ended = grader.returncode == 0
        assert starts < 30, said
    return kills, starts


@pytest.mark.parametrize("number", range(ROUNDS))
def test_kills_cost_nothing_but_time(course: Path, calm: tuple[dict[str, bytes], float], number: int) -> None:
    """Workers, fork servers and the grader are killed at random points; no result is lost, no byte differs."""
    wanted, seconds = calm
    kills, starts = _disturb(course, course / f"rough-{number}", seconds, random.Random(number))
    found = agreed(course / f"rough-{number}")
    found.pop("changes.csv", None)  # a submission whose worker was killed twice had no mark for a while, and this tells
    lost = wanted.keys() - found.keys()
    differing = [name for name in wanted if found.get(name) != wanted[name]]
    print(f"round {number}: {kills} kills, {starts} starts, {len(lost)} lost, {len(differing)} differing")
    assert kills == len(TARGETS)
    assert (lost, differing) == (set(), [])
    assert sorted(found) == sorted(wanted)


def test_the_class_covers_explanations(calm: tuple[dict[str, bytes], float]) -> None:
    """Mistakes of unknown kind are among the submissions, two of them in one group."""
    results = {name: calm[0][f"results/{name}.json"].decode() for name in CLASS}
    assert '"slip": null' in results["cleo"]
    assert '"counterexample": {' in results["cleo"]
    assert '"counterexample": {' in results["eve"]
