"""A dask cluster on this machine, made of processes as an administrator would start them."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Mapping
from pathlib import Path

DASK = [sys.executable, "-m", "dask"]
PRELOAD = Path(__file__).with_name("preload.py")
POISON = "the word that ends a worker"
START_SECONDS = 60.0


class Site:
    """One scheduler, and workers that come and go.

    Parameters
    ----------
    folder : Path
        For their files and logs.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.workers: list[subprocess.Popen[bytes]] = []
        self.scheduler = self._start("scheduler", "--port", "0")
        self.address = self._said("scheduler", "Scheduler at:")

    def worker(self, environment: Mapping[str, str] | None = None) -> subprocess.Popen[bytes]:
        """Start a worker process of one thread, and wait until the scheduler knows it."""
        name = f"worker-{len(self.workers)}"
        words = ["--nthreads", "1", "--no-nanny", "--preload", str(PRELOAD), "--local-directory", str(self.folder)]
        self.workers.append(self._start(name, *words, self.address, environment=environment))
        self._said(name, "Registered to:")
        return self.workers[-1]

    def end_workers(self) -> None:
        """End all workers that still live."""
        for process in self.workers:
            _end(process)

    def close(self) -> None:
        """End everything."""
        self.end_workers()
        _end(self.scheduler)

    def _start(self, name: str, *words: str, environment: Mapping[str, str] | None = None) -> subprocess.Popen[bytes]:
        kind = name.split("-", maxsplit=1)[0]
        local = ["--host", "127.0.0.1", "--no-dashboard", "--dashboard-address", "127.0.0.1:0"]
        with (self.folder / f"{name}.log").open("wb") as log:
            return subprocess.Popen(
                [*DASK, kind, *local, *words],
                stdout=log,
                stderr=log,
                env={**os.environ, "POISON": POISON, **(environment or {})},
            )

    def _said(self, name: str, word: str) -> str:
        """Wait until a process has logged a line with this word, and return what follows it."""
        deadline = time.monotonic() + START_SECONDS
        while time.monotonic() < deadline:
            text = (self.folder / f"{name}.log").read_text()
            found = [line.split(word)[1].strip() for line in text.splitlines() if word in line]
            if found:
                return found[0]
            time.sleep(0.05)
        raise TimeoutError(f"{name} did not say {word!r}: {text}")


def _end(process: subprocess.Popen[bytes]) -> None:
    process.send_signal(signal.SIGTERM)
    try:
        process.wait(timeout=10)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
