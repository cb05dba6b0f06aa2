"""Measure the grader beside its floor and beside its peers, all in one run: `python -m tests.benchmarks`.

The report and its plots are written into one folder. Machines differ and are noisy: compare the
ratios of one run, never the seconds of two.
"""

from __future__ import annotations

import argparse
import os
import platform
import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from statistics import median

import numpy as np

from tests.benchmarks.class_of import plain_texts, right_texts
from tests.benchmarks.growth import HEAD, by_itself, growth, row
from tests.benchmarks.one_core import floor_of_a_class, one_core
from tests.benchmarks.peers.measure import costs_table, installed, measure, misbehave, misbehaviour_table
from tests.benchmarks.plot import bars


def core_part(told: argparse.Namespace) -> str:
    """Correct submissions beside the floor."""
    return one_core(told.rounds, 20, told.examples)


def class_part(told: argparse.Namespace) -> str:
    """A class with a few endless loops, once in all styles and once in those of most students."""
    lines, floors = [HEAD], []
    for styles, texts in (("all", right_texts()), ("plain", plain_texts())):
        lines.append(row(by_itself(told.size, told.examples, told.loops, styles)))
        floors.append(floor_of_a_class(told.size, told.examples, texts))
    return (
        f"70 % right, the others slips, crashes and {told.loops} endless loops, which cost seconds each; "
        f"{told.examples} cases a stage, every mistake explained. First line: right submissions in all styles of the "
        "specimens, second line: in eight that most students use.\n\n" + "\n".join(lines) + "\n\n"
        f"The floor of {told.size:,} correct submissions, measured between: {floors[0]:.1f} s in all styles, "
        f"{floors[1]:.1f} s in the plain ones. That is what the functions of students take on all cores.\n"
    )


def growth_part(told: argparse.Namespace) -> str:
    """Classes of growing size, without endless loops."""
    sizes = [size for size in (10, 30, 100, 300, 1000, 3000, 10_000) if size <= told.most]
    table, plot = growth(sizes, told.examples)
    (told.output / "growth.svg").write_text(plot)
    return f"{table}\n![Time and memory over the size of a class](growth.svg)\n"


def peers_part(told: argparse.Namespace) -> str:
    """The same submissions through every peer."""
    with tempfile.TemporaryDirectory() as folder:
        places, versions = installed((told.environments or Path(folder)).absolute())
        costs = measure(places, told.submissions, told.rounds)
    (told.output / "peers.svg").write_text(bars({name: median(c.cpu for c in found) for name, found in costs.items()}))
    return (
        f"Medians of {told.rounds} rounds of {told.submissions} correct submissions, for one submission. The peers run "
        "four functions on 200 graphs; this grader and the floor six stages of 200 cases.\n\n"
        f"{costs_table(costs, versions)}\n![CPU seconds a submission](peers.svg)\n"
    )


def misbehaviours_part(told: argparse.Namespace) -> str:
    """What each peer gives to submissions that do not do the homework."""
    with tempfile.TemporaryDirectory() as folder:
        places, _ = installed((told.environments or Path(folder)).absolute())
        return "Stages with full marks.\n\n" + misbehaviour_table(misbehave(list(places), places))


PARTS: dict[str, tuple[str, Callable[[argparse.Namespace], str]]] = {
    "core": ("One core, beside the floor", core_part),
    "class": ("A class", class_part),
    "peers": ("Beside other graders", peers_part),
    "misbehaviours": ("What other graders let through", misbehaviours_part),
    "growth": ("Growth", growth_part),
}


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure the parts that are asked for, and write the report."""
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks", description=__doc__)
    parser.add_argument("parts", nargs="*", metavar="PART", help=f"of {', '.join(PARTS)}; without one, all")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--submissions", type=int, default=20, help="that every peer grades a round")
    parser.add_argument("--examples", type=int, default=200, help="cases a stage")
    parser.add_argument("--class", dest="size", type=int, default=1000, help="size of the class")
    parser.add_argument("--loops", type=int, default=5, help="endless loops in the class")
    parser.add_argument("--most", type=int, default=1000, help="the largest class of the growth")
    parser.add_argument("--environments", type=Path, help="folder that keeps the environments of the peers")
    parser.add_argument("-o", "--output", type=Path, default=Path("bench"), help="folder for report and plots")
    told = parser.parse_args(arguments)
    chosen = told.parts or list(PARTS)
    for part in chosen:
        if part not in PARTS:
            parser.error(f"there is no part {part}; expected some of {', '.join(PARTS)}")
    told.output.mkdir(parents=True, exist_ok=True)
    machine = f"Python {platform.python_version()}, numpy {np.__version__}, {os.cpu_count()} processors"
    sections = [f"# Benchmarks\n\nMeasured in one run: {machine}.\n"]
    for part in chosen:
        title, measured = PARTS[part]
        print(f"--- {title}", file=sys.stderr, flush=True)
        sections.append(f"## {title}\n\n{measured(told)}")
        (told.output / "report.md").write_text("\n".join(sections))
        print(sections[-1], flush=True)


if __name__ == "__main__":
    main()
