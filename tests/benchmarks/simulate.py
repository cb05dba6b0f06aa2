"""Simulate a night on a cluster from recorded task times: `python -m tests.benchmarks.simulate OUT`.

OUT is the folder of a real run; the seconds of its results are the task times that are drawn from.
The model has one client that gives out tasks one after another, one scheduler that spends a fixed
time on each, and workers that take the task's time; it knows no network but a fixed delay.
"""

from __future__ import annotations

import argparse
import heapq
import json
from collections.abc import Sequence
from pathlib import Path

import numpy as np

SCHEDULER_SECONDS = 0.0005  # "a few hundred microseconds", says dask of its scheduler; the client adds its own
DELAY_SECONDS = 0.005  # from a result to the next task of the same worker, where none waits there
DEPTH = 2  # tasks a worker has
NIGHT_SECONDS = 8 * 3600.0


def recorded(out: Path) -> list[float]:
    """Read the task times of a run."""
    seconds = [json.loads(path.read_bytes())["seconds"] for path in sorted((out / "results").glob("*.json"))]
    return [each for each in seconds if each > 0]


def night(times: Sequence[float], count: int, workers: int, central: float = SCHEDULER_SECONDS) -> float:
    """Return the seconds that `count` submissions take.

    Examples
    --------
    >>> round(night([1.0], 100, 10, central=0.0), 1)
    10.0
    >>> round(night([0.001], 1000, 1000, central=0.01), 1)  # the scheduler is the limit
    10.0
    """
    draw = np.random.default_rng(0).choice(np.asarray(times), size=count)
    free = [(0.0, number) for number in range(workers)]  # when a worker has done what it was given
    heapq.heapify(free)
    places = [[0.0] * DEPTH for _ in range(workers)]  # when each of its places is free again
    centre, last = 0.0, 0.0
    for seconds in draw.tolist():
        done, worker = heapq.heappop(free)
        place = heapq.heappop(places[worker])
        centre = max(centre, place) + central  # nothing is given before there is a place, and one after another
        begins = max(done, centre + (DELAY_SECONDS if centre > done else 0.0) * (central > 0))
        ends = begins + seconds
        heapq.heappush(places[worker], ends)
        heapq.heappush(free, (ends, worker))
        last = max(last, ends)
    return last


def fewest(times: Sequence[float], count: int, limit: float = NIGHT_SECONDS) -> int | None:
    """Return the fewest workers that are done within the limit; None where no number is enough."""
    if count * SCHEDULER_SECONDS > limit:
        return None
    low, high = 1, 1
    while night(times, count, high) > limit:
        low, high = high, 2 * high
    while low < high:
        middle = (low + high) // 2
        if night(times, count, middle) <= limit:
            high = middle
        else:
            low = middle + 1
    return high


def main() -> None:
    """Print the table of docs/scale.md."""
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.simulate", description=__doc__)
    parser.add_argument("out", type=Path, help="folder of a run")
    parser.add_argument("--cores", type=int, default=16, help="cores, and so worker processes, of one machine")
    parser.add_argument("--scale", type=float, default=1.0, help="multiply the recorded times, for another machine")
    told = parser.parse_args()
    times = [told.scale * each for each in recorded(told.out)]
    mean = float(np.mean(times))
    print(f"{len(times)} recorded times: mean {mean:.3f} s, median {np.median(times):.3f} s, most {max(times):.2f} s")
    print("| submissions | CPU hours | workers for 8 h | machines | then it takes [h] | the scheduler is busy |")
    print("|---|---|---|---|---|---|")
    for count in (100_000, 1_000_000):
        workers = fewest(times, count)
        if workers is None:
            print(f"| {count:,} | {count * mean / 3600:.1f} | the scheduler is too slow | | | |")
            continue
        took = night(times, count, workers)
        busy = count * SCHEDULER_SECONDS / took
        machines = -(-workers // told.cores)
        print(f"| {count:,} | {count * mean / 3600:.1f} | {workers} | {machines} | {took / 3600:.2f} | {busy:.1%} |")
    night_of_most = int(NIGHT_SECONDS / SCHEDULER_SECONDS)
    print(f"A scheduler that spends {1e3 * SCHEDULER_SECONDS:g} ms on a task ends {night_of_most:,} tasks in a night.")


if __name__ == "__main__":
    main()
