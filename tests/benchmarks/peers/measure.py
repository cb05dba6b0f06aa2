"""Grade the same submissions with every peer, in turn: what it costs, and what it lets through."""

from __future__ import annotations

import json
import os
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

import autograder
from tests.benchmarks.class_of import REFERENCE
from tests.benchmarks.one_core import exam, floor_seconds
from tests.benchmarks.peers.misbehaviour import CASES
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
OURS, FLOOR = "this grader", "floor"
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


def measure(places: Mapping[str, Path], count: int, rounds: int) -> dict[str, list[Cost]]:
    """Grade the same correct submissions with all peers in turn, round by round; cost of one submission each.

    Our own start is paid once a run, not once a submission: it is measured with as many and with
    eleven times as many, and what the difference costs is what a submission costs.
    """
    found: dict[str, list[Cost]] = {}
    plan, again = exam(200)
    for _ in range(rounds):
        wall, cpu, peak = floor_seconds(plan.inputs, again, [REFERENCE] * count)
        found.setdefault(FLOOR, []).append(Cost(wall / count, cpu / count, peak))
        few, many = whole(OURS, places[OURS], count), whole(OURS, places[OURS], 11 * count)
        more = 10 * count
        each = Cost((many.wall - few.wall) / more, (many.cpu - few.cpu) / more, many.peak)
        found.setdefault(OURS, []).append(each)
        found.setdefault(f"{OURS}, {count} with its start", []).append(
            Cost(few.wall / count, few.cpu / count, few.peak)
        )
        for system in places:
            if system != OURS:
                cost = whole(system, places[system], count)
                found.setdefault(system, []).append(Cost(cost.wall / count, cost.cpu / count, cost.peak))
        for system, costs in found.items():
            print(f"  {system}: {costs[-1].wall:.3f} s", file=sys.stderr, flush=True)
    return found


def whole(system: str, python: Path, count: int) -> Cost:
    """Let one peer grade so many correct submissions; return what all of it took."""
    texts = {f"s{number:03d}": f"# student {number}\n{REFERENCE}" for number in range(count)}
    with tempfile.TemporaryDirectory() as folder:
        job = SYSTEMS[system](python, texts, Path(folder) / "work")
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
    return Cost(wall, cpu, peak)


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


def costs_table(costs: Mapping[str, list[Cost]], versions: Mapping[str, str]) -> str:
    """Write what every peer costs, in Markdown."""
    own = median(cost.cpu for cost in costs[OURS])
    lines = [
        "| grader | version | wall [ms] | CPU [ms] | CPU, ours = 1 | largest process, peak [MB] |",
        "|---|---|---|---|---|---|",
    ]
    for system, found in costs.items():
        wall, cpu = median(cost.wall for cost in found), median(cost.cpu for cost in found)
        peak = median(cost.peak for cost in found)
        version = versions.get(system.partition(",")[0], "")
        lines.append(f"| {system} | {version} | {1e3 * wall:.0f} | {1e3 * cpu:.0f} | {cpu / own:.1f} | {peak:.0f} |")
    return "\n".join(lines) + "\n"


def misbehaviour_table(table: Mapping[str, Mapping[str, str]]) -> str:
    """Write what every peer gives to every misbehaviour, in Markdown."""
    systems = list(next(iter(table.values())))
    lines = [f"| submission | {' | '.join(systems)} |", "|---" * (len(systems) + 1) + "|"]
    lines += [f"| {title} | {' | '.join(row[system] for system in systems)} |" for title, row in table.items()]
    return "\n".join(lines) + "\n"


def installed(folder: Path) -> tuple[dict[str, Path], dict[str, str]]:
    """Install the peers that are missing; return the Python of each, and its version."""
    places = {OURS: Path(sys.executable)} | {system: environment(system, folder) for system in REQUIREMENTS}
    versions = {system: version(places[system], system) for system in REQUIREMENTS}
    return places, {OURS: autograder.__version__, **versions}
