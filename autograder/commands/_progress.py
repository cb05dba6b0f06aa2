"""How far grading is, on stderr: a bar in a terminal, a plain line now and then anywhere else."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, TextIO

if TYPE_CHECKING:
    from autograder.engine.grade import Progress

_SECONDS_BETWEEN_LINES = 5.0


@contextmanager
def progress(file: TextIO | None = None) -> Iterator[Callable[[Progress], None]]:
    """Give the function that the engine calls after each submission."""
    file = sys.stderr if file is None else file
    if file.isatty():
        with _bar(file) as report:
            yield report
    else:
        yield Lines(file)


class Lines:
    """Plain lines: the first submission, then one every few seconds, then the last."""

    def __init__(self, file: TextIO, clock: Callable[[], float] = time.monotonic) -> None:
        self.file, self.clock = file, clock
        self.start = self.last = clock()

    def __call__(self, at: Progress) -> None:
        """Print a line where one is due."""
        now = self.clock()
        if at.done < at.total and now - self.last < _SECONDS_BETWEEN_LINES:
            return
        self.last = now
        print(line(at, now - self.start), file=self.file, flush=True)


def line(at: Progress, seconds: float) -> str:
    """Say how far grading is: count, rate, time left."""
    text = f"graded {at.done} of {at.total}"
    if at.reused:
        text += f", {at.reused} unchanged"
    run = at.done - at.reused
    if run > 0 and seconds > 0:
        rate = run / seconds
        text += f", {rate:.1f} a second" if rate >= 1 else f", {1 / rate:.1f} s each"
        if at.done < at.total:
            text += f", about {(at.total - at.done) / rate:.0f} s left"
    return text


@contextmanager
def _bar(file: TextIO) -> Iterator[Callable[[Progress], None]]:
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeRemainingColumn
    from rich.progress import Progress as Bar

    columns = (
        TextColumn("grading"),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("{task.fields[rate]}"),
        TimeRemainingColumn(compact=True),
        TextColumn("{task.fields[submission]}", markup=False),
    )
    start = time.monotonic()
    with Bar(*columns, console=Console(file=file), transient=True) as bar:
        task = bar.add_task("grading", total=None, rate="", submission="")

        def report(at: Progress) -> None:
            from autograder.reports.wording import visible

            run = at.done - at.reused
            rate = f"{run / max(time.monotonic() - start, 1e-9):.1f}/s" if run else ""
            bar.update(task, completed=at.done, total=at.total, rate=rate, submission=visible(at.submission, 24))

        yield report
