"""Grade the same submissions with every peer, in turn: `python -m tests.benchmarks --peers`."""

from __future__ import annotations

import argparse
import json
import os
import platform
import re
import resource
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import numpy as np

import autograder
from tests.benchmarks.class_of import REFERENCE
from tests.benchmarks.peers.misbehaviour import CASES
from tests.benchmarks.peers.plot import bars
from tests.benchmarks.peers.systems import (
    REQUIREMENTS,
    Job,
    environment,
    gradescope,
    nbgrader,
    otter,
    ours,
    version,
)

SYSTEMS: dict[str, Callable[[Path, Mapping[str, str], Path], Job]] = {
    "this grader": ours,
    "gradescope-utils": gradescope,
    "nbgrader": nbgrader,
    "otter-grader": otter,
}
FULL = {"4 of 4", "6 of 6"}
PATIENCE_SECONDS = 60.0  # for one command that meets a misbehaviour


@dataclass(frozen=True)
class Cost:
    """What a submission took: seconds that passed, seconds of the processors, memory of the largest process."""

    wall: float
    cpu: float
    peak: float


def run(job: Job, patience: float | None = None) -> tuple[Cost, str]:
    """Run the commands of a job; return what they took, and what they printed or `no end`."""
    began, before = time.perf_counter(), _used()
    said, peak = "", 0.0
    for words in job.commands:
        process = subprocess.Popen(
            words,
            cwd=job.folder,
            env=job.environ,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
        try:
            output, _ = process.communicate(timeout=patience)
            said += output.decode("utf-8", "replace")
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            said = "no end"
    after = _used()
    peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    return Cost(time.perf_counter() - began, after - before, peak), said


def _used() -> float:
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def score(system: str, job: Job, said: str, name: str) -> str:
    """Read what a peer gave for the four functions, as `4 of 4`."""
    if said == "no end":
        return f"no end in {PATIENCE_SECONDS:.0f} s"
    try:
        if system == "this grader":
            result = next(json.loads(line) for line in said.splitlines() if line.startswith("{"))
            passed = [stage["status"] == "passed" for stage in result["stages"]]
            return f"{sum(passed)} of {len(passed)}"
        if system == "gradescope-utils":
            tests = json.loads((job.folder / name / "results.json").read_text())["tests"]
            return f"{sum(test['score'] == test['max_score'] for test in tests)} of {len(tests)}"
        if system == "otter-grader":
            tests = json.loads((job.folder / name / "results.json").read_text())["tests"]
            rows = [test for test in tests if test["name"] != "Public Tests"]
            return f"{sum(test.get('score') == test.get('max_score') for test in rows)} of {len(rows)}"
        import sqlite3  # noqa: PLC0415 - one peer only

        with sqlite3.connect(job.folder / "gradebook.db") as book:
            of_all = "select sum(auto_score) * 1.0 / (select count(*) from submitted_assignment) from grade"
            (given,) = book.execute(of_all).fetchone()
        return "no score" if given is None else f"{given:g} of 4"
    except (OSError, ValueError, StopIteration, KeyError) as error:
        return f"no score ({type(error).__name__})"


def measure(systems: Sequence[str], places: Mapping[str, Path], count: int, rounds: int) -> dict[str, list[Cost]]:
    """Grade the same correct submissions with all peers in turn, round by round; cost of one submission each."""
    found: dict[str, list[Cost]] = {system: [] for system in systems}
    texts = {f"s{number:02d}": f"# student {number}\n{REFERENCE}" for number in range(count)}
    for _ in range(rounds):
        for system in systems:
            with tempfile.TemporaryDirectory() as folder:
                job = SYSTEMS[system](places[system], texts, Path(folder) / "work")
                reader, writer = os.pipe()
                if os.fork() == 0:  # a process of its own, so that the peak is of this peer alone
                    try:
                        cost, said = run(job)
                        given = {score(system, job, said, name) for name in texts}
                        os.write(writer, json.dumps([cost.wall, cost.cpu, cost.peak, sorted(given)]).encode())
                    finally:
                        os._exit(0)
                os.close(writer)
                with os.fdopen(reader) as pipe:
                    wall, cpu, peak, given = json.loads(pipe.read())
                os.wait()
                if not given or any(each not in FULL for each in given):  # else an error would be measured
                    raise SystemExit(f"{system} gave correct submissions {given}.")
                found[system].append(Cost(wall / count, cpu / count, peak))
                print(f"  {system}: {wall / count:.2f} s", file=sys.stderr, flush=True)
    return found


def misbehave(systems: Sequence[str], places: Mapping[str, Path]) -> dict[str, dict[str, str]]:
    """Let every peer grade every misbehaviour, which stands below a correct submission and overrides it."""
    table: dict[str, dict[str, str]] = {}
    for title, text in CASES.items():
        table[title] = {}
        name = re.sub(r"\W+", "_", title)
        for system in systems:
            with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
                job = SYSTEMS[system](places[system], {name: f"{REFERENCE}\n\n{text}"}, Path(folder) / "work")
                _, said = run(job, PATIENCE_SECONDS)
                table[title][system] = score(system, job, said, name)
                print(f"  {title}, {system}: {table[title][system]}", file=sys.stderr, flush=True)
    return table


def report(costs: Mapping[str, list[Cost]], versions: Mapping[str, str], table: Mapping[str, Mapping[str, str]]) -> str:
    """Write both tables in Markdown."""
    own = median(cost.cpu for cost in costs["this grader"])
    lines = ["| grader | version | wall [s] | CPU [s] | CPU, ours = 1 | peak [MB] |", "|---|---|---|---|---|---|"]
    for system, found in costs.items():
        wall, cpu = median(cost.wall for cost in found), median(cost.cpu for cost in found)
        peak = median(cost.peak for cost in found)
        lines.append(f"| {system} | {versions[system]} | {wall:.3f} | {cpu:.3f} | {cpu / own:.1f} | {peak:.0f} |")
    if table:
        lines += ["", f"| submission | {' | '.join(costs)} |", "|---" * (len(costs) + 1) + "|"]
        lines += [f"| {title} | {' | '.join(row[system] for system in costs)} |" for title, row in table.items()]
    return "\n".join(lines) + "\n"


def main(arguments: Sequence[str] | None = None) -> None:
    """Install what is missing, measure, and write the tables and the plot."""
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks --peers", description=__doc__)
    parser.add_argument("--environments", type=Path, help="folder that keeps the peers' environments")
    parser.add_argument("--submissions", type=int, default=20)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--only", choices=tuple(REQUIREMENTS), action="append", help="leave the other peers out")
    parser.add_argument("--no-misbehaviours", action="store_true")
    parser.add_argument("-o", "--output", type=Path, default=Path("peers"), help="folder for the table and the plot")
    told = parser.parse_args(arguments)
    with tempfile.TemporaryDirectory() as folder:
        systems = ["this grader", *(told.only or REQUIREMENTS)]
        kept = (told.environments or Path(folder)).absolute()
        places = {system: environment(system, kept) for system in systems[1:]} | {"this grader": Path(sys.executable)}
        versions = {system: version(places[system], system) for system in systems[1:]}
        versions["this grader"] = autograder.__version__
        costs = measure(systems, places, told.submissions, told.rounds)
        table = {} if told.no_misbehaviours else misbehave(systems, places)
    text = (
        f"Medians of {told.rounds} rounds of {told.submissions} correct submissions, a submission; "
        f"Python {platform.python_version()}, numpy {np.__version__}, {os.cpu_count()} processors.\n\n"
        + report(costs, versions, table)
    )
    told.output.mkdir(parents=True, exist_ok=True)
    (told.output / "peers.md").write_text(text)
    (told.output / "peers.svg").write_text(bars({name: median(c.cpu for c in found) for name, found in costs.items()}))
    print(text)


if __name__ == "__main__":
    main()
