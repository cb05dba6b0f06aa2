"""Count what a class of 1,000 gets from each family, as the table of docs/variants.md.

    python -m tests.problems.counting

It takes about a minute. Only the rates depend on the machine.
"""

from __future__ import annotations

import math
import time
from collections import Counter
from collections.abc import Iterable

from autograder.commands._class import demand_of
from autograder.problems.families import family, names
from autograder.problems.ledger import Ledger
from autograder.problems.secret import Secret
from autograder.problems.stream import Stream

CLASS = 1000
SAMPLE = 10_000
SECRET = Secret(b"0123456789abcdef")
HEADINGS = (
    "family",
    "different data",
    "different x⁽¹⁾",
    "different Δx",
    "in the band, exact",
    "mistakes shown",
    "drawn a second",
    "checked a second",
    "problems N",
    "pairs expected: data",
    "pairs expected: x⁽¹⁾",
    "thrown away",
)


def row(letter: str) -> list[str]:
    """Draw a class of one family, and a larger sample to count chance meetings."""
    chosen, demand, tally = family(letter), demand_of({letter: 1}), Counter[str]()
    began = time.process_time()
    variants = Ledger().extend(
        SECRET, "2026S", {f"s{k:04}": chosen for k in range(CLASS)}, accept=demand.accept, tally=tally
    )
    checked = CLASS / (time.process_time() - began)
    began = time.process_time()
    sample = [chosen.draw(Stream(b"a sample, no secret", letter, str(k))) for k in range(SAMPLE)]
    drawn = SAMPLE / (time.process_time() - began)
    good = sum(
        not chosen.band.complaints(each.exact, each.x1) and each.exact.solution() == each.x1 for each in variants
    )
    shown = demand.text().split()[3:6]
    problems = chosen.raw_count * SAMPLE / sum(draw.attempts for draw in sample)
    by_chance = meetings(draw.x1 for draw in sample) * math.comb(CLASS, 2) / math.comb(SAMPLE, 2)
    return [
        letter,
        str(len({each.exact for each in variants})),
        str(len({each.x1 for each in variants})),
        str(len({each.step for each in variants})),
        str(good),
        " ".join(shown),
        f"{drawn:,.0f}",
        f"{checked:,.0f}",
        f"{problems:.1e}",
        f"{math.comb(CLASS, 2) / problems:.1e}",
        f"{by_chance:.2g}",
        str(tally["collision"] + tally["not accepted"]),
    ]


def meetings(values: Iterable[object]) -> int:
    """Count the pairs that agree."""
    return sum(math.comb(count, 2) for count in Counter(values).values())


if __name__ == "__main__":
    print("| " + " | ".join(HEADINGS) + " |")
    print("|" + "---|" * len(HEADINGS))
    for each in (name for name in names() if name != "E"):
        print("| " + " | ".join(row(each)) + " |", flush=True)
