"""Correct submissions on one core beside the floor, in one run: milliseconds a submission, and the ratio."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from statistics import median

import msgspec

from autograder.engine.collect import collect
from autograder.engine.corpus import draw_corpus
from autograder.engine.judge import Judge
from autograder.engine.plan import Plan, make_plan
from autograder.sandbox.frames import Source
from autograder.sandbox.host import Limits, Sandbox
from autograder.stages.catalogue import all_stages
from tests.benchmarks.class_of import right_texts
from tests.benchmarks.floor import Work

EXAM = ("residual", "jacobian", "information_matrix", "normal_equations", "gauss_newton_step", "second_step")


def exam(examples: int) -> tuple[Plan, list[int]]:
    """Return the plan of the six stages, and for each of its batches how many second calls follow it."""
    stages = tuple(stage for stage in all_stages() if stage.name in EXAM)
    plan = make_plan(stages, {stage.name: stage.points for stage in stages}, draw_corpus(stages, 0, examples))
    return plan, [len(task.cases) if task.stage.name == "second_step" else 0 for task in plan.tasks]


def one_core(rounds: int, per_round: int, examples: int) -> str:
    """Grade correct submissions in many styles on one core, and run the floor between; return a table."""
    plan, again = exam(examples)
    calls = sum(len(set(task.asked.tolist())) for task in plan.tasks) + sum(again)
    texts = right_texts()
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {min(before)})
    walls, floor_walls, ours, floor = [], [], [], []
    judge = Judge(plan)
    with Sandbox(plan.inputs, Limits()) as sandbox:
        for number in range(rounds + 1):
            chosen = [texts[(number * per_round + index) % len(texts)] for index in range(per_round)]
            began, used = time.perf_counter(), cpu(sandbox.server.pid)
            for text in chosen:
                with sandbox.open(Source(kind="module", cells=[text], name="slam1d.py")) as session:
                    verdicts = judge.judge(collect(session, plan))
                assert all(verdict.score == verdict.max_score for verdict in verdicts)
            wall, busy = time.perf_counter() - began, cpu(sandbox.server.pid) - used
            lowest, least, _ = floor_seconds(plan.inputs, again, chosen)
            if number:  # the first round warms up
                walls.append(1e3 * wall / per_round)
                ours.append(1e3 * busy / per_round)
                floor_walls.append(1e3 * lowest / per_round)
                floor.append(1e3 * least / per_round)
    os.sched_setaffinity(0, before)
    ratios = [mine / least for mine, least in zip(ours, floor, strict=True)]
    return (
        f"Correct submissions in {len(texts)} styles, six stages, {examples} cases a stage, {calls:,} calls; "
        f"medians of {rounds} rounds of {per_round}.\n\n"
        "| on one core | processor [ms a submission] | wall [ms a submission] |\n|---|---|---|\n"
        f"| this grader | {median(ours):.1f} | {median(walls):.1f} |\n"
        f"| floor: the same calls, nothing judged | {median(floor):.1f} | {median(floor_walls):.1f} |\n"
        f"| ratio | {median(ratios):.2f} (least {min(ratios):.2f}, most {max(ratios):.2f}) | "
        f"{median(walls) / median(floor_walls):.2f} |\n"
    )


def cpu(server: int) -> float:
    """Return the processor seconds of this process, of the fork server, and of the children that it has reaped."""
    fields = Path(f"/proc/{server}/stat").read_text("ascii").rpartition(")")[2].split()
    ticks = sum(int(field) for field in fields[11:15])
    return time.process_time() + ticks / os.sysconf("SC_CLK_TCK")


def floor_seconds(inputs: bytes, again: list[int], texts: list[str]) -> tuple[float, float, float]:
    """Run the floor in a process of its own; return wall and processor seconds of its loop, and its memory in MB."""
    work = msgspec.msgpack.encode(Work(inputs, again, texts))
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    done = subprocess.run(
        [sys.executable, "-m", "tests.benchmarks.floor"], input=work, capture_output=True, check=True, env=environment
    )
    wall, used, peak = done.stdout.split()
    return float(wall), float(used), float(peak)


def floor_of_a_class(size: int, examples: int, texts: Sequence[str]) -> float:
    """Run the floor for so many correct submissions on all cores at once; return the seconds that pass."""
    plan, again = exam(examples)
    cores = len(os.sched_getaffinity(0))
    chosen = [texts[number % len(texts)] for number in range(size)]
    with ThreadPoolExecutor(cores) as pool:
        found = pool.map(lambda core: floor_seconds(plan.inputs, again, chosen[core::cores]), range(cores))
        return max(wall for wall, _, _ in found)
