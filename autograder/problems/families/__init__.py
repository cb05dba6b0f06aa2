"""Problem families: one file is one family, found by being here.

A file defines `LETTER` and `NAME`, and `family(options) -> Family`.
"""

from __future__ import annotations

import importlib
import pkgutil
from functools import cache
from types import ModuleType

from autograder.errors import UsageError
from autograder.problems.family import Family, Options, parse_options

__all__ = ["families", "family", "names"]


@cache
def _modules() -> dict[str, ModuleType]:
    found = {}
    for entry in pkgutil.iter_modules(__path__):
        module = importlib.import_module(f"{__name__}.{entry.name}")
        if module.LETTER in found:
            raise ValueError(f"LETTER must be unique, got {module.LETTER!r} in {entry.name}.py twice")
        found[module.LETTER] = module
    return dict(sorted(found.items()))


def names() -> dict[str, str]:
    """List the families: letter -> name."""
    return {letter: module.NAME for letter, module in _modules().items()}


def families() -> list[Family]:
    """Build every family with its own settings, in the order of their letters."""
    return [module.family(Options()) for module in _modules().values()]


@cache
def family(text: str) -> Family:
    """Build the family that a text names: letter or name, then options after a colon.

    Parameters
    ----------
    text : str
        Such as "A", "unequal-variances" or "B:poses=7,loops=1-5,prior_mean=2,decimals=2".

    Raises
    ------
    UsageError
        Where no family has this name, or an option does not fit.

    Examples
    --------
    >>> family("interior-loop").label, family("A: poses=6").label
    ('B', 'A:poses=6')
    """
    name, _, rest = text.partition(":")
    wanted = name.strip().casefold()
    for letter, module in _modules().items():
        if wanted in {letter.casefold(), module.NAME.casefold()}:
            built: Family = module.family(parse_options(rest))
            return built
    known = ", ".join(f"{letter} ({name})" for letter, name in names().items())
    raise UsageError(f"There is no family {name.strip()!r}; expected one of {known}.")
