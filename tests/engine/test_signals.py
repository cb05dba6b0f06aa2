"""Ctrl-C and TERM at any moment: the same end, what is graded is kept and counted, and nothing runs any more."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import time
from pathlib import Path

import pytest

from tests.engine import small_class

MOMENTS = int(os.environ.get("MOMENTS", "8"))  # `make crashes` asks for 100
GOLDEN = 0.6180339887498949
KEPT = re.compile(r"(\d+) of (\d+) (?:are|is) graded and kept")


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, float]:
    """A class with the exam that it was graded on, and how long that takes."""
    folder = small_class.make(tmp_path_factory.mktemp("signals"))
    began = time.monotonic()
    subprocess.run(small_class.command(folder, folder / "whole"), check=True, capture_output=True)
    return folder, time.monotonic() - began


@pytest.mark.slow
@pytest.mark.parametrize("number", range(MOMENTS))
def test_it_ends_the_same_way_whenever_it_is_asked(place: tuple[Path, float], tmp_path: Path, number: int) -> None:
    """Start and end included: every other time a stored exam makes the run a short one."""
    folder, seconds = place
    if number % 2:
        (tmp_path / "out").mkdir()
        shutil.copy(folder / "whole" / "exam", tmp_path / "out" / "exam")
    moment = (number * GOLDEN) % 1.0 * 1.1 * seconds
    sent = signal.SIGTERM if number % 3 == 2 else signal.SIGINT
    with subprocess.Popen(
        small_class.command(folder, tmp_path / "out"), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
    ) as process:
        time.sleep(moment)
        process.send_signal(sent)
        asked = time.monotonic()
        _, stderr = process.communicate(timeout=120)
        waited = time.monotonic() - asked
    assert process.returncode in {0, 130, -sent}, stderr
    assert "autograder/" not in stderr.partition("Traceback")[2]  # Python itself, not yet started, may be in one
    assert waited < max(10.0, 3 * seconds), "something was drawn or graded on the way out"
    results = list((tmp_path / "out" / "results").glob("[!.]*.json"))
    said = KEPT.search(stderr)
    if said:
        assert int(said[1]) == len(results)
    if process.returncode == 130 and results and not said:
        assert "Results so far are kept" in stderr
    if number % 4:
        return
    subprocess.run(small_class.command(folder, tmp_path / "out"), check=True, capture_output=True)
    assert small_class.agreed(tmp_path / "out") == small_class.agreed(folder / "whole")
