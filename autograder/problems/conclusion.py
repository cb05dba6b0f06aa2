"""The choices of question 3, in an order of its own for every variant.

A choice is stored and compared by its identifier; the letter that a student writes depends on the
variant. The wrong choices are beliefs met in the work of students.
"""

from __future__ import annotations

import hashlib
from typing import NamedTuple

__all__ = ["CHOICES", "RIGHT", "Choice", "choice_of", "choices"]


class Choice(NamedTuple):
    """One choice: the letter is given by the order."""

    letter: str
    identifier: str
    text: str


CHOICES: dict[str, str] = {
    "reached_truth": "One step reaches the true positions of the robot, so nothing is left that a further step could "
    "correct.",
    "few_poses": "The graph has few poses. A graph with hundreds of poses would need more steps before they become "
    "zero.",
    "good_start": "Dead reckoning is a good initial estimate. From a bad one, further steps would still be different "
    "from zero.",
    "loop_closed": "One step closes the loop: all measurements agree with the new state, so f is zero and the next "
    "step is too.",
    "float_noise": "The further steps are small but not exactly zero in the computer, so each of them still improves "
    "the estimate.",
    "linear": "The residual is an affine function of the state: J is the same everywhere, so a single step solves the "
    "problem from any start.",
}
"""Identifier -> text; the texts are printed in the handout, the identifiers are not."""

RIGHT = "linear"
"""The choice that explains it. The others are wrong, or true and beside the point."""


def choices(variant: str) -> list[Choice]:
    """Return the choices in the order of one variant, with their letters.

    Examples
    --------
    >>> [choice.letter for choice in choices("worked-example")]
    ['A', 'B', 'C', 'D', 'E', 'F']
    """

    def key(identifier: str) -> str:
        return hashlib.sha256(f"{variant}:{identifier}".encode()).hexdigest()

    order = sorted(CHOICES, key=key)
    return [Choice(chr(ord("A") + place), identifier, CHOICES[identifier]) for place, identifier in enumerate(order)]


def choice_of(variant: str, letter: str) -> Choice | None:
    """Return the choice that a letter names, or None where it names none.

    Examples
    --------
    >>> choice_of("worked-example", " a ").letter
    'A'
    >>> choice_of("worked-example", "G") is None
    True
    """
    named = letter.strip().strip("().").upper()
    return next((choice for choice in choices(variant) if choice.letter == named), None)
