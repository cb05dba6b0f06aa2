"""All stages, found in this folder: a new stage is one new file with a `STAGE` in it."""

from __future__ import annotations

import importlib
import pkgutil
from functools import cache

from autograder import stages as package
from autograder.stages import answers, written
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


@cache
def points() -> dict[str, float]:
    """Return the points of every stage where the course file says nothing, in the order of the homework.

    Examples
    --------
    >>> sum(points()[name] for name in points() if name not in bonus())
    100.0
    """
    main = {stage.name: stage.points for stage in all_stages() if not stage.bonus}
    extra = {stage.name: stage.points for stage in all_stages() if stage.bonus}
    return {**main, answers.NAME: answers.POINTS, written.NAME: written.POINTS, **extra}


@cache
def bonus() -> frozenset[str]:
    """Return the stages whose points are shown apart and come on top of the maximum."""
    return frozenset(stage.name for stage in all_stages() if stage.bonus)


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
