"""Right work and every catalogued mistake, as functions that a student might have written."""

import importlib
import pkgutil

import pytest

from autograder.stages import slips
from autograder.stages.base import Slip
from reference_solution import slam1d


def right_work():
    """Functions of the reference by name."""
    return {name: value for name, value in vars(slam1d).items() if callable(value)}


def all_slips():
    """Every catalogued slip with the name of its stage."""
    for module in pkgutil.iter_modules(slips.__path__):
        found = vars(importlib.import_module(f"{slips.__name__}.{module.name}")).get("SLIPS", ())
        for slip in found:
            if isinstance(slip, Slip):
                yield pytest.param(module.name, slip, id=f"{module.name}-{slip.identifier}")


def by_identifier(name):
    """The function of one catalogued slip."""
    return next(case.values[1].function for case in all_slips() if case.values[1].identifier == name)
