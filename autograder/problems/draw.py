"""Draw cases from a strategy: distinct, simplest first, the same for the same seed."""

from __future__ import annotations

import hashlib
import warnings
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cache

import numpy as np
from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st
from hypothesis.errors import HypothesisWarning
from hypothesis.strategies import SearchStrategy

from autograder.lifeline import postponed
from autograder.problems.cases import Case, key, simplicity
from autograder.problems.ladders import Ladder
from autograder.problems.strategies import STRATEGIES, square
from autograder.problems.tracks import leave_no_tracks

MAX_ROUNDS = 20
WIDTH = 8  # cases drawn as one example: most of the time of an example does not depend on its size


@dataclass(frozen=True)
class Made:
    """What is made of a drawn case: so many cases."""

    of: Callable[[Case], list[Case]]
    count: int


ALONE = Made(lambda case: [case], 1)
SQUARES = Made(square, 4)


def draw_ladder(ladder: Ladder, root_seed: int, examples: int) -> dict[str, tuple[Case, ...]]:
    """Draw the cases of every rung: its core, then its share of the examples.

    Parameters
    ----------
    ladder : Ladder
        Which rungs.
    root_seed : int
        The seed of the run.
    examples : int
        How many cases to draw in all, beside the core.

    Returns
    -------
    dict
        Name of the rung to its cases, the core first, then the drawn ones from simple to rich.
    """
    cases = {}
    drawn_rungs = [rung for rung in ladder.rungs if rung.share > 0]
    counts = _apportion([rung.share for rung in drawn_rungs], examples)
    wanted = {rung.name: count for rung, count in zip(drawn_rungs, counts, strict=True)}
    for rung in ladder.rungs:
        known = {key(case) for case in rung.core}
        drawn: list[Case] = []
        if wanted.get(rung.name):
            name = f"{root_seed}/{ladder.name}/{rung.name}"
            made = SQUARES if ladder.name == "loops" else ALONE
            drawn = draw_distinct(STRATEGIES[ladder.name][rung.name], wanted[rung.name], name, known, made)
        cases[rung.name] = (*rung.core, *drawn)
    return cases


def draw_distinct(
    strategy: SearchStrategy[Case],
    count: int,
    name: str,
    known: Iterable[bytes] = (),
    made: Made = ALONE,
) -> list[Case]:
    """Draw `count` cases that differ from each other and from the known ones, sorted from simple to rich.

    `name` names the stream: the same name gives the same cases. `made` says what is made of each draw.
    """
    leave_no_tracks()
    found: dict[bytes, Case] = {}
    refused = set(known)
    for attempt in range(MAX_ROUNDS):
        missing = count - len(found)
        if missing <= 0:
            break
        number = int.from_bytes(hashlib.sha256(f"{name}/{attempt}".encode()).digest()[:8], "big")
        for drawn in _generate(strategy, (missing + missing // 8) // made.count, number):
            if len(found) == count:
                break
            for case in made.of(drawn)[: count - len(found)]:
                identity = key(case)
                if identity not in refused:
                    found.setdefault(identity, case)
    if len(found) < count:
        raise RuntimeError(f"{name}: only {len(found)} of {count} distinct cases could be drawn")
    return sorted(found.values(), key=simplicity)


def _generate(strategy: SearchStrategy[Case], count: int, number: int) -> list[Case]:
    """Draw at least so many cases, not all of them distinct."""
    drawn: list[Case] = []

    @seed(number)
    @settings(
        max_examples=count // WIDTH + 3,  # the first is the simplest there is, eight times
        database=None,
        deadline=None,
        phases=[Phase.generate],
        suppress_health_check=list(HealthCheck),
    )
    @given(_rows_of(strategy))
    def collect(cases: tuple[Case, ...]) -> None:
        drawn.extend(cases)

    # Hypothesis would take an interruption for a fault of what it runs; a rung is drawn in less than 0.1 s.
    with warnings.catch_warnings(), postponed():
        warnings.simplefilter("ignore", HypothesisWarning)
        collect()
    return drawn


@cache
def _rows_of(strategy: SearchStrategy[Case]) -> SearchStrategy[tuple[Case, ...]]:
    return st.tuples(*[strategy] * WIDTH)


def _apportion(shares: list[float], total: int) -> list[int]:
    """Split a total by shares so that the parts add up to it."""
    ends = np.rint(np.cumsum(shares) / sum(shares) * total).astype(int)
    return [int(part) for part in np.diff(ends, prepend=0)]
