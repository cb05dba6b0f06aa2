"""The smallest witness: Hypothesis draws small cases until one goes wrong, and its shrinker reduces that one."""

from __future__ import annotations

import random
import warnings
from collections.abc import Callable

from hypothesis import HealthCheck, Phase, Verbosity, find, settings
from hypothesis.errors import HypothesisException, HypothesisWarning

from autograder.problems.cases import Case, key
from autograder.problems.tracks import leave_no_tracks
from autograder.problems.witnesses import WITNESSES

GENERATED = 60  # cases drawn from a strategy before it is given up
BUDGET = 600  # calls of `is_wrong` in all: a count, so that the witness is the same on every machine


def smallest_witness(ladder: str, is_wrong: Callable[[Case], bool], budget: int = BUDGET) -> Case | None:
    """Find a small case that goes wrong.

    Parameters
    ----------
    ladder : str
        Which kind of case.
    is_wrong : callable
        Whether a case goes wrong; called at most `budget` times, and once only for each case.
    budget : int
        How many calls are allowed.

    Returns
    -------
    case or None
        None where no small case goes wrong within the budget.

    Examples
    --------
    >>> x, graph = smallest_witness("graphs", lambda case: case[1].measurements.any())
    >>> graph.n_poses, len(graph.edges)
    (2, 1)
    """
    leave_no_tracks()
    known: dict[bytes, bool] = {}

    def condition(case: Case) -> bool:
        identity = key(case)
        if identity not in known:
            if len(known) >= budget:
                return False
            known[identity] = is_wrong(case)
        return known[identity]

    rules = settings(
        max_examples=GENERATED,
        database=None,
        deadline=None,
        phases=[Phase.generate, Phase.shrink],
        suppress_health_check=list(HealthCheck),
        verbosity=Verbosity.quiet,
    )
    for strategy in WITNESSES[ladder]:
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", HypothesisWarning)
                return find(strategy, condition, settings=rules, random=random.Random(0))
        except HypothesisException:
            continue
    return None
