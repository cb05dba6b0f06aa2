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
    "reached_truth": "The first step reaches the true positions of the robot; nothing is left to correct.",
    "few_poses": "The graph has few poses; with hundreds of them the further steps would look different.",
    "good_start": "Dead reckoning is a good initial estimate; from a bad one, the further steps would look different.",
    "loop_closed": "The first step closes the loop: now all measurements agree with the state, and f is zero.",
    "float_noise": "The computer rounds: small or not, each further step still improves the estimate.",
    "linear": "f is of a kind with which the first step ends at the same place, from wherever it began.",
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
