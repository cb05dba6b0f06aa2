"""Prints what the hostile corpus shows: attempts by kind, tried, through without the locks, through with them.

    python -m tests.hostile.table        or: make hostile

Attempts are counted one by one where a specimen makes several, as root and as an ordinary user.
A specimen without attempts counts as one: it got through if the real `grade` command gave it more
than its honest marks. Built uploads count likewise, as refused or graded on merit.
"""

from __future__ import annotations

import os
import platform
import statistics
import sys
import tempfile
import time
from collections.abc import Iterable, Mapping
from pathlib import Path

from autograder.sandbox.frames import Inputs, Source, encode_inputs
from autograder.sandbox.host import Sandbox
from tests.hostile import attempts, corpus, neighbours, uploads
from tests.hostile.conftest import Graded, grade
from tests.hostile.corpus import SECTIONS, Case

Through = Mapping[str, list[str]] | None
COLUMNS = ("kind", "cases", "attempts", "root, no locks", "root, locks", "user, no locks", "user, locks")
_MISSING = "not run"
ROUNDS = 100  # submissions of each kind, to measure what the locks cost


def main() -> int:
    """Run everything and print; 1 where anything got through with the locks on."""
    cases = corpus.cases()
    trying = [case.name for case in cases if case.attempts]
    root = os.geteuid() == 0
    runs: list[Through] = [None] * 4
    if root:
        runs[0] = attempts.in_a_place_to_throw_away(trying, locked=False)
        runs[1] = attempts.in_a_place_to_throw_away(trying, locked=True)
    runs[2] = attempts.in_a_place_to_throw_away(trying, locked=False, ordinary=root)
    runs[3] = attempts.in_a_place_to_throw_away(trying, locked=True, ordinary=root)
    lines = [_line(section, [case for case in cases if case.section == section], runs) for section in SECTIONS]
    lines.append(["all", *(_sum(line[column] for line in lines) for column in range(1, len(COLUMNS)))])
    print(f"{platform.system()} {platform.release()} {platform.machine()}, Python {platform.python_version()}\n")
    _print_table([list(COLUMNS), *lines])
    with tempfile.TemporaryDirectory(prefix="slam1d-table-") as folder:
        graded, beyond = _class(cases, Path(folder))
    _print_class(cases, graded, beyond)
    locked, unlocked = cost()
    print(f"A submission from fork to end, median of {ROUNDS}: {locked:.2f} ms locked, {unlocked:.2f} ms unlocked.")
    through = sum(len(won) for run in (runs[1], runs[3]) if run is not None for won in run.values())
    return 1 if through or beyond else 0


def cost() -> tuple[float, float]:
    """Measure what a submission takes from fork to end [ms], with the locks and without, in turns: the medians."""
    inputs = encode_inputs(Inputs(objects=[], batches=[]))
    source = Source("module", ["def residual(x, graph):\n    return x\n"], "honest")
    with Sandbox(inputs) as locked, Sandbox(inputs, allow_unconfined=True, without=attempts.ALL_LOCKS) as unlocked:
        times: list[list[float]] = [[], []]
        for number in range(2 * (ROUNDS + 5)):
            began = time.perf_counter()
            with (locked, unlocked)[number % 2].open(source) as session:
                session.load()
                session.fresh()
            times[number % 2].append(1000 * (time.perf_counter() - began))
    first, second = (statistics.median(each[5:]) for each in times)
    return first, second


def _line(section: str, cases: list[Case], runs: list[Through]) -> list[str]:
    tried = sum(len(case.attempts) for case in cases)
    counts = [_MISSING if run is None else str(sum(len(run.get(case.name, [])) for case in cases)) for run in runs]
    return [section, str(len(cases)), str(tried), *(counts if tried else ["-"] * len(counts))]


def _sum(entries: Iterable[str]) -> str:
    entries = list(entries)
    return _MISSING if _MISSING in entries else str(sum(int(entry) for entry in entries if entry != "-"))


def _class(cases: list[Case], folder: Path) -> tuple[Graded, list[str]]:
    """Grade the whole corpus in one class; name those with more than their honest marks."""
    uploaded = folder / "class"
    neighbours.write(uploaded)
    for case in cases:
        (uploaded / case.path.name).write_bytes(case.path.read_bytes())
    for upload in uploads.uploads():
        (uploaded / upload.name).write_bytes(upload.data)
    graded = grade(uploaded, folder / "out")
    scores = {name: result.score for name, result in graded.results().items()}
    return graded, [case.name for case in cases if (scores[case.name] or 0.0) > case.honest()]


def _print_class(cases: list[Case], graded: Graded, beyond: list[str]) -> None:
    seen = graded.guard
    built = len(list(uploads.uploads()))
    print(f"\nThe real command over one class of {len(cases)} specimens, {built} built uploads and honest neighbours:")
    print(f"  more than the honest marks       {len(beyond)} {' '.join(beyond)}")
    print(f"  processes left, signals heard    {seen['processes_left']}, {len(seen['signals'])}")
    print(f"  largest process of the grader    {seen['peak_kib'] / 1024:.0f} MiB")
    print(f"  time                             {seen['seconds']:.0f} s, {seen['cpu_seconds']:.0f} s of computing")
    left_out = [case.name for case in cases if case.destructive]
    print(f"Never run without the locks, as they take all memory: {', '.join(left_out)}.")


def _print_table(rows: list[list[str]]) -> None:
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        first, *rest = (
            entry.ljust(width) if place == 0 else entry.rjust(width)
            for place, (entry, width) in enumerate(zip(row, widths, strict=True))
        )
        print("  ".join([first, *rest]))


if __name__ == "__main__":
    sys.exit(main())
