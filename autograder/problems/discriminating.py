"""Which mistakes a variant can show: a known mistake that gives the right answer is not caught by it.

The mistakes are arguments, because this room does not know the stages; so are the right functions
round them. A mistake is a function of the problem and the start that returns the state it reaches.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from assignment.posegraph import PoseGraph
from autograder.problems.exact import floats
from autograder.problems.family import Family
from autograder.problems.stream import Stream
from autograder.problems.variants import Variant

__all__ = ["Demand", "Mistake", "Sharpness", "mistaken", "sharpness", "unseen"]

Mistake = Callable[[PoseGraph, np.ndarray], np.ndarray]

PROBES = 100
SAME = 1e-6  # answers that agree so far are taken for the same: float noise is below, hundredths are above
NUDGE = 1e-9  # [m]
RARE = 0.05


@dataclass(frozen=True)
class Sharpness:
    """How often each known mistake changes the answer on a family.

    Parameters
    ----------
    family : str
        Label of the family.
    shares : mapping
        Mistake -> share of the probed problems on which it changes the answer.
    """

    family: str
    shares: Mapping[str, float]

    @property
    def shown(self) -> tuple[str, ...]:
        """Mistakes that the family can show: every released variant shows them."""
        return tuple(name for name, share in self.shares.items() if share >= RARE)

    @property
    def blind(self) -> tuple[str, ...]:
        """Mistakes that the family shows never, or hardly ever: the grader's own cases cover them."""
        return tuple(name for name, share in self.shares.items() if share < RARE)

    def text(self) -> str:
        """Say in a few lines what the family shows and what it does not."""
        lines = [f"Family {self.family} shows {len(self.shown)} of {len(self.shares)} known mistakes."]
        if self.blind:
            lines.append("It cannot show these; the grader's own cases do:")
            lines += [f"  {name}" for name in sorted(self.blind)]
        return "\n".join(lines)


class Demand:
    """What a released variant must show: every known mistake that its family can show.

    Parameters
    ----------
    families : iterable of Family
        The families of the release; each is probed once.
    mistakes : mapping
        The known mistakes.
    """

    def __init__(self, families: Iterable[Family], mistakes: Mapping[str, Mistake]) -> None:
        self._found = {family.label: sharpness(family, mistakes) for family in families if family.personal}
        self._demanded = {label: {name: mistakes[name] for name in found.shown} for label, found in self._found.items()}

    def accept(self, variant: Variant) -> bool:
        """Whether all the mistakes that the family can show change the answer on this variant."""
        return not unseen(variant, self._demanded[variant.family])

    def text(self) -> str:
        """Say for each family what it shows and what it cannot."""
        return "\n\n".join(found.text() for found in self._found.values()) + "\n"


def mistaken(right: Mapping[str, Callable[..., Any]], stage: str, wrong: Callable[..., Any]) -> Mistake:
    """Put a wrong function of one stage among right ones, and take one step with them.

    Parameters
    ----------
    right : mapping
        residual, jacobian, information_matrix and normal_equations: the right functions.
    stage : str
        One of these, or another stage: then `wrong` is the step itself, called as (x, graph).
    wrong : callable
        The wrong function.

    Returns
    -------
    callable
        From (graph, start) to the state after the step.
    """
    use = dict(right) | {stage: wrong}

    def first_state(graph: PoseGraph, start: np.ndarray) -> np.ndarray:
        if stage not in right:
            return np.asarray(start + np.asarray(wrong(start.copy(), graph)))
        f, J = use["residual"](start.copy(), graph), use["jacobian"](start.copy(), graph)
        H, b = use["normal_equations"](J, use["information_matrix"](graph), f)
        return np.asarray(start + np.linalg.solve(H, -np.asarray(b)))

    return first_state


def unseen(variant: Variant, mistakes: Mapping[str, Mistake]) -> tuple[str, ...]:
    """Name the mistakes that give the right answer on a variant.

    A mistake that raises, or returns another shape or no numbers, is seen.
    """
    return _unseen(variant.graph, variant.start, floats(variant.x1), mistakes)


def sharpness(family: Family, mistakes: Mapping[str, Mistake]) -> Sharpness:
    """Try the mistakes on 100 problems of a family, the same ones each time."""
    missed = dict.fromkeys(mistakes, 0)
    for probe in range(PROBES):
        draw = family.draw(Stream(b"probes of a family, no secret", family.label, str(probe)))
        start, answer = floats(draw.graph.dead_reckoning()), floats(draw.x1)
        for name in _unseen(draw.graph.posegraph(), start, answer, mistakes):
            missed[name] += 1
    return Sharpness(family.label, {name: 1 - count / PROBES for name, count in missed.items()})


def _unseen(
    graph: PoseGraph, start: np.ndarray, answer: np.ndarray, mistakes: Mapping[str, Mistake]
) -> tuple[str, ...]:
    # A singular system can be solved rightly by luck, and the luck depends on the machine: try again beside the start.
    beside = start + NUDGE * np.sin(np.arange(1, len(start) + 1))
    with np.errstate(all="ignore"):
        return tuple(
            name
            for name, mistake in mistakes.items()
            if _right(graph, start, answer, mistake) and _right(graph, beside, answer, mistake)
        )


def _right(graph: PoseGraph, start: np.ndarray, answer: np.ndarray, mistake: Mistake) -> bool:
    try:
        got = np.asarray(mistake(graph, start.copy()), dtype=np.float64)
    except Exception:  # noqa: BLE001 - whatever a wrong function does, it is not the right answer
        return False
    return got.shape == answer.shape and bool(np.all(np.abs(got - answer) <= SAME))
