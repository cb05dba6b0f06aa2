"""The self-check passes right work, fails known mistakes, and holds no answer."""

import ast
import importlib
import pkgutil
import re
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import assignment.posegraph
from autograder.problems import families
from autograder.problems.secret import Secret
from autograder.problems.variants import draw_variant
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


WIDTH = 100  # characters that a page shows of a line before it breaks it in the middle of a word

# What would answer question 2 or 3 before a student has.
CLUES = (
    r"(?i)second step",
    r"(?i)one step",
    r"(?i)nothing",
    r"(?i)vanish",
    r"(?i)linear",
    r"(?i)quadratic",
    r"(?i)any start",
    r"(?i)lowest",
    r"(?i)minimum",
)


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
    shown = capsys.readouterr().out
    assert shown.endswith(f"\n{self_check.UNSEEN}\n")
    lines = shown[: -len(self_check.UNSEEN) - 1].splitlines()
    assert len(lines) == sum(len(checks) for checks in self_check.STAGES.values())
    assert [line for line in lines if not line.startswith("PASS  ")] == []
    assert max(map(len, shown.splitlines())) <= WIDTH
    told = re.sub(r"(?m)^PASS  \w+: ", "", shown)
    assert [clue for clue in CLUES if re.search(clue, told)] == []


@pytest.mark.parametrize("letter", sorted(families.names()))
def test_right_work_passes_on_every_family(self_check, letter):
    """On a student's own numbers nothing fails, whatever the family."""
    problem = draw_variant(Secret(b"0123456789abcdef"), "2026S", "s1", families.family(letter)).problem
    rows = [problem.start]
    for _ in range(3):
        rows.append(rows[-1] + slam1d.gauss_newton_step(rows[-1], problem.graph))
    work = {**right_work(), "my_graph": problem.graph, "my_start": problem.start, "iterates": np.array(rows)}
    found = {stage: self_check.failures(stage, work) for stage in self_check.STAGES}
    assert [(stage, wrong) for stage, checks in found.items() for _, wrong in checks if wrong] == []


def test_the_words_are_the_graders(self_check):
    """Rows, numbers and vectors are named in the self-check as the grader names them."""
    for graph in (self_check.WORKED, self_check.PUBLIC["two priors"][1]):
        for row in range(graph.n_factors):
            assert self_check.factor(graph, row) == wording.factor(graph, row)
    for value in (0.0, -0.0, 1200.0, 0.1 + 0.2, -2.5, 1e9):
        assert self_check.number(value) == wording.number(value)
    assert self_check.vector(np.array([1.0, -0.0, 2.5])) == wording.vector(np.array([1.0, -0.0, 2.5]))


def test_an_older_python_can_read_it():
    """Both provided files parse as Python 3.9, and import numpy and the standard library only."""
    for name in ("self_check.py", "posegraph.py"):
        tree = ast.parse((FILE.parent / name).read_text(encoding="utf-8"), feature_version=(3, 9))
        imported = {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
        imported |= {n.name for node in ast.walk(tree) if isinstance(node, ast.Import) for n in node.names}
        assert {str(name).partition(".")[0] for name in imported} <= {*sys.stdlib_module_names, "numpy", "posegraph"}


@pytest.mark.parametrize(("stage", "slip"), [case for case in all_slips() if case.values[0] == "second_step"])
def test_the_second_step_is_still_checked(self_check, stage, slip):
    """Each known mistake of the second step fails in its own stage, and no message says what right code gives."""
    found = self_check.failures(stage, {**right_work(), "gauss_newton_step": slip.function})
    assert any(wrong for _, wrong in found)
    assert not any(re.search(r"not 0|should be 0|expected", wrong) for _, wrong in found)


@pytest.mark.parametrize(
    ("function", "message"),
    [
        (lambda *_: None, "returned None, expected an array of shape (6,)"),
        (lambda *_: "f", "returned str, expected an array of shape (6,)"),
        (lambda x, _: x, "returned shape (5,), expected (6,)"),
        (lambda *_: np.full(6, np.nan), "not finite"),
        (lambda *_: 1 / 0, "raised ZeroDivisionError: division by zero (line"),
    ],
    ids=["none", "str", "shape", "nan", "raises"],
)
def test_odd_values_are_named(self_check, function, message):
    """None, text, a wrong shape, nan and an error each give FAIL with what came and what was expected."""
    found = self_check.failures("residual", {**right_work(), "residual": function})
    assert all(message in wrong for _line, wrong in found)


def test_unfinished_work_is_no_failure(self_check, capsys):
    """A stub or a missing function is open work: TODO in the whole list, one sentence under its cell."""

    def residual(x, graph):
        raise NotImplementedError

    with pytest.raises(self_check.Unfinished, match="residual is not finished yet"):
        self_check.check("residual", {"residual": residual})
    with pytest.raises(self_check.Unfinished, match="jacobian is not defined"):
        self_check.check("jacobian", {})
    self_check.check_all({})
    lines = [line for line in capsys.readouterr().out.splitlines() if not line.startswith(" ")]
    assert [line[:4] for line in lines] == ["TODO"] * 7 + ["What"]


def test_wrong_iterates_are_pointed_at(self_check):
    """A row that does not follow from the row before is named, and so is a wrong shape."""
    graph, x = self_check.WORKED, self_check.WORKED.dead_reckoning()
    work = {**right_work(), "my_graph": graph, "my_start": x}
    ((_, wrong),) = self_check.failures("iterates", {**work, "iterates": np.array([x, x, x, x])})
    assert "row 1 of iterates" in wrong
    ((_, wrong),) = self_check.failures("iterates", {**work, "iterates": np.zeros((2, 5))})
    assert "expected (4, 5)" in wrong
