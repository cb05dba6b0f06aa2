"""The gallery: small cases, from simple to rich, of which whoever is wrong is shown the first that goes wrong.

It holds, for every known mistake, the smallest case that shows it, found by Hypothesis and reduced by
its shrinker; and drawn cases of few poses and whole numbers for the mistakes that nobody has met
yet. All of that is worked out when a slip is written, not when a class is graded:
`python -m autograder.diagnosis` writes `gallery.json` anew.
"""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

from autograder.problems.cases import Case
from autograder.problems.plain import argument

FILE = Path(__file__).with_name("gallery.json")


@cache
def gallery(ladder: str) -> tuple[Case, ...]:
    """Return the small cases of one ladder, the simplest first.

    Examples
    --------
    >>> x, graph = gallery("graphs")[0]
    >>> graph.n_poses
    2
    """
    found = json.loads(FILE.read_text(encoding="utf-8"))[ladder]
    return tuple(tuple(argument(data) for data in case) for case in found)
