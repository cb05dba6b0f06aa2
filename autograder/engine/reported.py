"""Keep what a student reported beside what is right, for whoever marks the words to it."""

from __future__ import annotations

from autograder.engine.settle import settled
from autograder.problems.conclusion import RIGHT, choice_of, choices
from autograder.problems.plain import plain
from autograder.sandbox.host import Answers
from autograder.stages.answers import Sheet
from autograder.verdicts import Reported

_LARGEST = 4096  # numbers of a table that anybody would read


def reported(sheet: Sheet, given: Answers) -> Reported:
    """Lay the answers of a student beside those of the variant on record."""
    own, said = given.iterates, given.said_of("iterates")
    if own is not None and (own.ndim != 2 or own.size > _LARGEST):
        said, own = f"an array of shape {own.shape}", None
    letter = given.conclusion or ""
    choice = choice_of(sheet.variant, letter)
    letters = {one.identifier: one.letter for one in choices(sheet.variant)}
    return Reported(
        graph=plain(sheet.graph),
        right=settled(sheet.iterates).tolist(),
        iterates=[] if own is None else settled(own).tolist(),
        said=said,
        conclusion=letter[:40],
        choice="" if choice is None else choice.text,
        right_letter=letters[RIGHT],
        letters=letters,
    )
