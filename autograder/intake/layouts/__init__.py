"""Layouts: how a course lays out what was handed in; one file here is one layout.

Every module of this package is found by itself; there is no list to extend. A layout module has

- `TITLE`: a few words for people; its name for ``--layout`` is the module's name,
- `recognise(tree)`: how sure the layout is that the tree is its own, from 0 (not at all) to 1; the surest wins,
- `gather(tree)`: the uploads in the tree, one a student.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cache

from autograder.errors import UsageError
from autograder.intake.tree import Tree
from autograder.intake.upload import Upload

GENERIC = 0.3  # layouts that know no system by its marks claim at most this much


@dataclass(frozen=True)
class Layout:
    """One layout, as found in this package."""

    name: str
    title: str
    recognise: Callable[[Tree], float]
    gather: Callable[[Tree], list[Upload]]


@cache
def layouts() -> tuple[Layout, ...]:
    """Find every layout of this package, sorted by name."""
    found = []
    for module in sorted(info.name for info in pkgutil.iter_modules(__path__)):
        code = importlib.import_module(f"{__name__}.{module}")
        found.append(Layout(module, code.TITLE, code.recognise, code.gather))
    return tuple(found)


def named(name: str) -> Layout:
    """Return the layout of this name; raises UsageError with the known ones where there is none."""
    known = {layout.name: layout for layout in layouts()}
    if name in known:
        return known[name]
    close = get_close_matches(name, known, n=1)
    hint = f"did you mean {close[0]}?" if close else f"known are {', '.join(known)}."
    raise UsageError(f"There is no layout {name!r}; {hint}")


def detect(tree: Tree, name: str | None = None) -> tuple[Layout, Tree]:
    """Return the layout that is surest, or the named one, and the tree as it wants it.

    A folder that only wraps another one is looked through; of equal claims the outermost wins.
    """
    eligible = layouts() if name is None else (named(name),)
    claims = []
    wrapped: Tree | None = tree
    for _ in range(4):
        if wrapped is not None:
            claims += [(layout.recognise(wrapped), layout, wrapped) for layout in eligible]
            wrapped = wrapped.unwrapped()
    sureness, layout, chosen = max(claims, key=lambda claim: claim[0])  # the first of equals
    return (layout, chosen) if sureness > 0 else (eligible[0] if name else named("plain"), tree)
