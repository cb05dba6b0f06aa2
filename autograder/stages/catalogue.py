"""All stages, found in this folder: a new stage is one new file with a `STAGE` in it."""

from __future__ import annotations

import importlib
import pkgutil
from functools import cache

from autograder import stages as package
from autograder.stages.base import Slip, Stage


@cache
def all_stages() -> tuple[Stage, ...]:
    """Return every stage, in the order in which students meet them.

    Examples
    --------
    >>> [stage.name for stage in all_stages()][:3]
    ['residual', 'jacobian', 'information_matrix']
    """
    modules = (
        importlib.import_module(f"{package.__name__}.{found.name}") for found in pkgutil.iter_modules(package.__path__)
    )
    found = (getattr(module, "STAGE", None) for module in modules)
    return tuple(sorted((stage for stage in found if stage is not None), key=lambda stage: stage.position))


def stage(name: str) -> Stage:
    """Return the stage of this name."""
    return next(stage for stage in all_stages() if stage.name == name)


@cache
def slips(name: str) -> tuple[Slip, ...]:
    """Return the known mistakes of a stage: what `slips/<stage>.py` holds, if there is one."""
    path = f"{package.__name__}.slips.{name}"
    try:
        module = importlib.import_module(path)
    except ModuleNotFoundError as error:
        if error.name != path:
            raise
        return ()
    return tuple(module.SLIPS)
