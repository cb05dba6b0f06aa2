"""Grade classes of growing size, each in a process of its own: time and memory, as a table and a plot."""

from __future__ import annotations

import argparse
import json
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

from autograder.course import Course
from autograder.engine.grade import Settings, grade
from tests.benchmarks.class_of import class_of, plain_texts, right_texts
from tests.benchmarks.plot import Line, lines


def a_class(size: int, examples: int, loops: int, styles: str = "all") -> dict[str, float]:
    """Grade one class on all cores from nothing, with every explanation; return seconds and megabytes."""
    submissions = class_of(size, loops=loops, rights=plain_texts() if styles == "plain" else right_texts())
    first: list[float] = []
    with tempfile.TemporaryDirectory() as folder:
        began = time.perf_counter()
        run = grade(
            submissions,
            Course(),
            Settings(examples=examples),
            Path(folder),
            lambda _: first.append(time.perf_counter() - began),
        )
        seconds = time.perf_counter() - began
    assert {result.status for result in run.results} == {"graded"}
    return {
        "size": size,
        "right": sum(result.score is not None and result.score >= 90 for result in run.results),
        "seconds": seconds,
        "first": first[0],
        "client": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
        "largest": resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024,
    }


def by_itself(size: int, examples: int, loops: int, styles: str = "all") -> dict[str, float]:
    """Grade one class in a fresh process."""
    words = ["-m", "tests.benchmarks.growth", str(size), "--examples", str(examples), "--loops", str(loops)]
    done = subprocess.run([sys.executable, *words, "--styles", styles], check=True, capture_output=True, text=True)
    found: dict[str, float] = json.loads(done.stdout)
    print(f"  {size} submissions, {styles} styles: {found['seconds']:.1f} s", file=sys.stderr, flush=True)
    return found


def row(found: dict[str, float]) -> str:
    """Write one class as a row of a table."""
    return (
        f"| {found['size']:,} | {found['right']:,} | {found['seconds']:.1f} | {found['size'] / found['seconds']:.1f} | "
        f"{found['first']:.2f} | {found['client']:.0f} | {found['largest']:.0f} |"
    )


HEAD = (
    "| submissions | right | seconds | a second | first result [s] | client, peak [MB] | largest other process [MB] |\n"
    "|---|---|---|---|---|---|---|"
)


def growth(sizes: Sequence[int], examples: int) -> tuple[str, str]:
    """Grade a class of every size; return the table and the plot."""
    found = [by_itself(size, examples, 0) for size in sizes]
    table = "\n".join([HEAD, *map(row, found)]) + "\n"
    plot = lines(
        "Time and memory over the size of a class",
        "submissions",
        [
            Line("time [s]", [(one["size"], one["seconds"]) for one in found]),
            Line("memory of the client [MB]", [(one["size"], one["client"]) for one in found], dashed=True),
        ],
    )
    return table, plot


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.growth", description=__doc__)
    parser.add_argument("size", type=int)
    parser.add_argument("--examples", type=int, default=200)
    parser.add_argument("--loops", type=int, default=0)
    parser.add_argument("--styles", choices=("all", "plain"), default="all")
    told = parser.parse_args()
    print(json.dumps(a_class(told.size, told.examples, told.loops, told.styles)))
