"""Measure the grader beside the floor, in one run: `python -m tests.benchmarks`."""

import argparse
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

import msgspec
import numpy as np

from autograder.course import Course
from autograder.engine.collect import collect
from autograder.engine.corpus import draw_corpus
from autograder.engine.grade import Settings, grade
from autograder.engine.judge import Judge
from autograder.engine.plan import make_plan
from autograder.sandbox.host import Limits, Sandbox
from autograder.stages.catalogue import all_stages
from tests.benchmarks.class_of import REFERENCE, class_of, right_texts
from tests.benchmarks.floor import Work

EXAM = ("residual", "jacobian", "information_matrix", "normal_equations", "gauss_newton_step", "second_step")


def one_core(rounds: int, per_round: int, examples: int) -> None:
    """Grade correct submissions on one core, and run the floor between; print milliseconds and the ratio."""
    stages = tuple(stage for stage in all_stages() if stage.name in EXAM)
    plan = make_plan(stages, {stage.name: stage.points for stage in stages}, draw_corpus(stages, 0, examples))
    calls = sum(len(task.stage.calls(case)) for task in plan.tasks for case in task.cases)
    again = [len(task.cases) if task.stage.name == "second_step" else 0 for task in plan.tasks]
    texts = right_texts()
    os.sched_setaffinity(0, {sorted(os.sched_getaffinity(0))[0]})
    walls, floor_walls, ours, floor = [], [], [], []
    judge = Judge(plan)
    with Sandbox(plan.inputs, Limits()) as sandbox:
        for number in range(rounds + 1):
            chosen = [texts[(number * per_round + index) % len(texts)] for index in range(per_round)]
            began, used = time.perf_counter(), cpu(sandbox.server.pid)
            for text in chosen:
                source = class_of(1)[0].source
                source.cells[:] = [text]
                with sandbox.open(source) as session:
                    verdicts = judge.judge(collect(session, plan))
                assert all(verdict.score == verdict.max_score for verdict in verdicts)
            wall, busy = time.perf_counter() - began, cpu(sandbox.server.pid) - used
            lowest, least = floor_seconds(plan.inputs, again, chosen)
            if number:  # the first round warms up
                walls.append(wall / per_round)
                ours.append(busy / per_round)
                floor_walls.append(lowest / per_round)
                floor.append(least / per_round)
    ratios = [mine / least for mine, least in zip(ours, floor, strict=True)]
    print(f"one core, correct submissions, {len(stages)} stages, {examples} cases a stage, {calls} calls and more")
    print(f"  milliseconds a submission, medians of {rounds} rounds: processor, wall")
    print(f"  grader {1e3 * median(ours):9.1f} {1e3 * median(walls):9.1f}")
    print(f"  floor  {1e3 * median(floor):9.1f} {1e3 * median(floor_walls):9.1f}")
    print(f"  ratio of processor time: {median(ratios):.2f} (least {min(ratios):.2f}, most {max(ratios):.2f})")
    os.sched_setaffinity(0, range(os.cpu_count() or 1))


def cpu(server: int) -> float:
    """Return the processor seconds of this process, of the fork server, and of the children that it has reaped."""
    fields = Path(f"/proc/{server}/stat").read_text("ascii").rpartition(")")[2].split()
    ticks = sum(int(field) for field in fields[11:15])
    return time.process_time() + ticks / os.sysconf("SC_CLK_TCK")


def floor_seconds(inputs: bytes, again: list[int], texts: list[str]) -> tuple[float, float]:
    """Run the floor in a process of its own, on the same core; return the wall and processor seconds of its loop."""
    work = msgspec.msgpack.encode(Work(inputs, again, texts))
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    done = subprocess.run(
        [sys.executable, "-m", "tests.benchmarks.floor"], input=work, capture_output=True, check=True, env=environment
    )
    wall, used = done.stdout.split()
    return float(wall), float(used)


def a_class(size: int, examples: int, loops: int) -> None:
    """Grade a class on all cores from nothing; print rate, time to the first result and peak memory."""
    submissions = class_of(size, loops=loops)
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
    right = sum(result.score is not None and result.score >= 90 for result in run.results)
    own = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    largest = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    print(f"a class of {size} ({right} right, {loops} endless loops), all cores, {examples} cases a stage")
    print(f"  {seconds:7.1f} s in all, {size / seconds:.1f} submissions a second")
    print(f"  {first[0]:7.1f} s to the first result")
    print(f"  {own:7.0f} MB peak memory of the client, {largest:.0f} MB of its largest process")


def main() -> None:
    """Read the sizes and measure."""
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks", description=__doc__)
    parser.add_argument("--rounds", type=int, default=7, help="rounds on one core")
    parser.add_argument("--per-round", type=int, default=20, help="submissions a round")
    parser.add_argument("--examples", type=int, default=200, help="cases a stage")
    parser.add_argument("--class", dest="size", type=int, default=200, help="size of the class")
    parser.add_argument("--loops", type=int, default=0, help="endless loops in the class")
    told = parser.parse_args()
    print(f"python {sys.version.split()[0]}, numpy {np.__version__}, {os.cpu_count()} processors")
    one_core(told.rounds, told.per_round, told.examples)
    a_class(told.size, told.examples, told.loops)


if __name__ == "__main__":
    assert REFERENCE
    if sys.argv[1:2] == ["--peers"]:
        from tests.benchmarks.peers.__main__ import main as against_peers

        against_peers(sys.argv[2:])
    else:
        main()
