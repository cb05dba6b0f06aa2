"""The self-check passes right work, fails known mistakes, and holds no answer."""

import ast
import importlib
import pkgutil
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import assignment.posegraph
from autograder.stages import slips, wording
from autograder.stages.base import Slip
from reference_solution import slam1d

sys.modules.setdefault("posegraph", assignment.posegraph)
FILE = Path(__file__).parents[2] / "assignment" / "self_check.py"


@pytest.fixture(scope="module")
def self_check():
    """The self-check as a student imports it."""
    sys.modules["posegraph"] = assignment.posegraph
    return importlib.import_module("assignment.self_check")


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


# What only the grader sees, with the reason.
ONLY_THE_GRADER = {
    "difference_step_too_small": "the lost digits show at states far from 0, and the public ones are near",
}


def failing(self_check, work):
    """Stages at which some check fails."""
    core = [stage for stage in self_check.STAGES if stage not in self_check.BONUS and stage != "iterates"]
    return [stage for stage in core if any(wrong for _, wrong in self_check.failures(stage, work))]


@pytest.mark.parametrize(("stage", "slip"), list(all_slips()))
def test_a_known_mistake_fails(self_check, stage, slip):
    """A slip pasted into right work fails some check, or is in the list of what only the grader sees."""
    function = "gauss_newton_step" if stage == "second_step" else stage
    seen = failing(self_check, {**right_work(), function: slip.function})
    assert bool(seen) != (slip.identifier in ONLY_THE_GRADER)


def test_right_work_passes_everything_quickly(self_check, capsys):
    """The reference passes every line, in less than 2 s, and the last line says what is not seen."""
    graph = self_check.WORKED
    x = graph.dead_reckoning()
    rows = [x]
    for _ in range(3):
        rows.append(rows[-1] + slam1d.gauss_newton_step(rows[-1], graph))
    began = time.perf_counter()
    self_check.check_all({**right_work(), "my_graph": graph, "my_start": x, "iterates": np.array(rows)})
    assert time.perf_counter() - began < 2.0
    *lines, last = capsys.readouterr().out.splitlines()
    assert len(lines) == sum(len(checks) for checks in self_check.STAGES.values())
    assert [line for line in lines if not line.startswith("PASS  ")] == []
    assert last == self_check.UNSEEN
