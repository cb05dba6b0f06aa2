"""Measure what the locks cost a submission: `python -m tests.benchmarks.locks --pairs 100`.

The same submission runs by turns in a locked and in an unlocked child, each from a fork server of its own,
so that whatever else the machine does falls on both. Medians of the wall clock, and of the differences of
neighbours; the processor's time is that of all of one side, by the count of the kernel.
"""

import argparse
import os
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median, quantiles

from autograder.engine.collect import collect
from autograder.engine.corpus import draw_corpus
from autograder.engine.plan import make_plan
from autograder.sandbox.frames import Batch, Source
from autograder.sandbox.host import Limits, Sandbox, Session
from autograder.stages.catalogue import all_stages

LOCKS = ("seccomp", "landlock", "rlimits")
ROOT = Path(__file__).resolve().parents[2]


def measure(inputs: bytes, source: Source, work: Callable[[Session], object], pairs: int) -> str:
    """Run by turns with and without the locks; the side that begins alternates, the first turns warm up."""
    with (
        Sandbox(inputs, Limits()) as locked,
        Sandbox(inputs, Limits(), without=LOCKS, allow_unconfined=True) as unlocked,
    ):
        seconds: dict[Sandbox, list[float]] = {locked: [], unlocked: []}
        used: dict[Sandbox, float] = {locked: 0.0, unlocked: 0.0}
        for number in range(pairs + 5):
            for sandbox in (locked, unlocked) if number % 2 else (unlocked, locked):
                busy, began = time.process_time() + of_children(sandbox), time.perf_counter()
                with sandbox.open(source) as session:
                    work(session)
                took = time.perf_counter() - began
                if number >= 5:
                    seconds[sandbox].append(took)
                    used[sandbox] += time.process_time() + of_children(sandbox) - busy
    milliseconds = [[1e3 * each for each in seconds[sandbox]] for sandbox in (locked, unlocked)]
    differences = [with_ - without for with_, without in zip(*milliseconds, strict=True)]
    low, _, high = quantiles(differences, n=4)
    with_, without = map(median, milliseconds)
    busy_with, busy_without = (1e3 * used[sandbox] / pairs for sandbox in (locked, unlocked))
    return (
        f"locked {with_:.2f} ms, unlocked {without:.2f} ms; a pair differs by {median(differences):+.2f} ms "
        f"(quartiles {low:+.2f} and {high:+.2f}); processor {busy_with:.1f} and {busy_without:.1f} ms; {pairs} pairs"
    )


def of_children(sandbox: Sandbox) -> float:
    """Seconds of computing of a fork server and the children that it has reaped."""
    fields = Path(f"/proc/{sandbox.server.pid}/stat").read_text().rpartition(")")[2].split()
    return sum(map(int, fields[11:15])) / os.sysconf("SC_CLK_TCK")


def main() -> None:
    """Measure from the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pairs", type=int, default=100)
    chosen = parser.parse_args()
    stages = all_stages()
    plan = make_plan(stages, {stage.name: stage.points for stage in stages}, draw_corpus(stages, 0, 200))
    smallest = Source("module", ["def f():\n    return 1.0\n"], "smallest")
    right = Source("module", [(ROOT / "reference_solution" / "slam1d.py").read_text(encoding="utf-8")], "right")
    print("load average before:", *(f"{each:.1f}" for each in os.getloadavg()))
    call = Batch("f", 1, 1, [[]])
    print("one call:  ", measure(plan.inputs, smallest, lambda session: session.call(call), chosen.pairs))
    print("whole exam:", measure(plan.inputs, right, lambda session: collect(session, plan), chosen.pairs))


if __name__ == "__main__":
    main()
