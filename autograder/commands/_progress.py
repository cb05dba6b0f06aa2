"""How far grading is, on stderr: a bar in a terminal, a plain line now and then anywhere else."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from typing import NamedTuple, Protocol, TextIO

_SECONDS_BETWEEN_LINES = 5.0


class Progress(Protocol):
    """How far something is: `done` of `total`, `reused` of them from before; the last one's name."""

    @property
    def done(self) -> int:
        """How many are done."""

    @property
    def total(self) -> int:
        """How many there are."""

    @property
    def reused(self) -> int:
        """How many of those done cost nothing."""

    @property
    def submission(self) -> str:
        """The one that was done last."""


class Step(NamedTuple):
    """Progress of what is no grading."""

    done: int
    total: int
    submission: str
    reused: int = 0


@contextmanager
def progress(
    file: TextIO | None = None, doing: str = "grading", did: str = "graded"
) -> Iterator[Callable[[Progress], None]]:
    """Give the function that is called after each submission.

    Parameters
    ----------
    file : TextIO, optional
        Where it is shown; stderr if not given.
    doing, did : str
        What is done, for a bar and for a line.
    """
    file = sys.stderr if file is None else file
    if file.isatty():
        with _bar(file, doing) as report:
            yield report
    else:
        yield Lines(file, did=did)


def shown(stack: ExitStack, doing: str, did: str) -> Callable[[int, int, str], None]:
    """Give a function that shows progress; the bar opens at its first call, and closes the one before it."""
    reports: list[Callable[[int, int, str], None]] = []

    def report(done: int, total: int, name: str) -> None:
        if not reports:
            stack.close()
            show = stack.enter_context(progress(doing=doing, did=did))
            reports.append(lambda *at: show(Step(*at)))
        reports[0](done, total, name)

    return report


class Lines:
    """Plain lines: the first submission, then one every few seconds, then the last."""

    def __init__(self, file: TextIO, clock: Callable[[], float] = time.monotonic, did: str = "graded") -> None:
        self.file, self.clock, self.did = file, clock, did
        self.start = self.last = clock()

    def __call__(self, at: Progress) -> None:
        """Print a line where one is due."""
        now = self.clock()
        if at.done < at.total and now - self.last < _SECONDS_BETWEEN_LINES:
            return
        self.last = now
        print(line(at, now - self.start, self.did), file=self.file, flush=True)


def line(at: Progress, seconds: float, did: str = "graded") -> str:
    """Say how far grading is: count, rate, time left."""
    text = f"{did} {at.done} of {at.total}"
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
def _bar(file: TextIO, doing: str) -> Iterator[Callable[[Progress], None]]:
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeRemainingColumn
    from rich.progress import Progress as Bar

    columns = (
        TextColumn(doing),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("{task.fields[rate]}"),
        TimeRemainingColumn(compact=True),
        TextColumn("{task.fields[submission]}", markup=False),
    )
    start = time.monotonic()
    with Bar(*columns, console=Console(file=file), transient=True) as bar:
        task = bar.add_task(doing, total=None, rate="", submission="")

        def report(at: Progress) -> None:
            from autograder.reports.wording import visible

            run = at.done - at.reused
            rate = f"{run / max(time.monotonic() - start, 1e-9):.1f}/s" if run else ""
            bar.update(task, completed=at.done, total=at.total, rate=rate, submission=visible(at.submission, 24))

        yield report
