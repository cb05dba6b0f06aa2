"""Mutants of the reference: the operators of cosmic-ray and a few for matrices, applied one at a time."""

from __future__ import annotations

import difflib
import itertools
from collections.abc import Iterator
from dataclasses import dataclass

from cosmic_ray.mutating import mutate_code
from cosmic_ray.plugins import get_operator, operator_names

from tests.mutation.operators import OPERATORS

# They need to be told which variables to exchange, and say nothing about operators.
LEFT_OUT = ("core/VariableReplacer", "core/VariableInserter")


@dataclass(frozen=True)
class Mutant:
    """The reference with one place changed.

    Parameters
    ----------
    operator : str
        The operator of the tool.
    old, new : str
        The line before and after.
    text : str
        The whole module.
    """

    operator: str
    old: str
    new: str
    text: str


def mutants(source: str) -> Iterator[Mutant]:
    """Apply every operator to every place where it fits; the same text is made once."""
    seen = {source}
    theirs = [get_operator(name) for name in operator_names() if name not in LEFT_OUT]
    for operator in (*theirs, *OPERATORS):
        for occurrence in itertools.count():
            text = mutate_code(source, operator(), occurrence)
            if text is None:
                break
            if text not in seen:
                seen.add(text)
                yield Mutant(operator.__name__, *_changed(source, text), text)


def _changed(source: str, text: str) -> tuple[str, str]:
    lines = list(difflib.unified_diff(source.splitlines(), text.splitlines(), n=0, lineterm=""))[3:]
    old, new = ([line[1:].strip() for line in lines if line[0] == sign] for sign in "-+")
    return " ".join(old), " ".join(new)
