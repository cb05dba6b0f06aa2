"""The self-check passes right work, fails known mistakes, and holds no answer."""

import ast
import json
import re
import subprocess
import sys
import time
from pathlib import Path

import hypothesis
import numpy as np
import pytest

from autograder.problems import families
from autograder.problems.secret import Secret
from autograder.problems.variants import draw_variant
from autograder.sandbox import policy
from reference_solution import slam1d
from tests.assignment.mistakes import all_slips, by_identifier, right_work

FILE = Path(__file__).parents[2] / "assignment" / "self_check.py"
CORRECT = sorted((FILE.parents[1] / "autograder" / "specimens" / "correct").glob("*.py"))

# What only the grader sees, with the reason.
ONLY_THE_GRADER: dict[str, str] = {}

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
    work = {
        **right_work(),
        "__name__": slam1d.__name__,
        "my_graph": graph,
        "my_start": x,
        "iterates": np.array(rows),
        "conclusion": "A",
    }
    self_check.check_all(work)
    assert time.perf_counter() - began < 2.0
    shown = capsys.readouterr().out
    assert shown.endswith(f"\n{self_check.UNSEEN}\n")
    lines = shown[: -len(self_check.UNSEEN) - 1].splitlines()
    assert len(lines) == sum(len(checks) for checks in self_check.STAGES.values())
    assert [line for line in lines if not line.startswith("PASS  ")] == []
    assert max(map(len, shown.splitlines())) <= 100
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


@pytest.mark.filterwarnings("ignore:the matrix subclass:PendingDeprecationWarning")  # one of the styles
@pytest.mark.parametrize("path", CORRECT, ids=lambda path: path.stem)
def test_every_correct_style_passes(self_check, path):
    """What the grader gives all points passes here; only a changed argument, there a remark, is a FAIL."""
    work = {"__name__": "slam1d"}
    exec(compile(path.read_bytes(), str(path), "exec"), work)
    assert bool(failing(self_check, work)) == (path.stem == "style_16_moves_its_argument")


def test_an_older_python_can_read_it():
    """Both provided files parse as Python 3.9, and import numpy and the standard library only."""
    for name in ("self_check.py", "posegraph.py"):
        tree = ast.parse((FILE.parent / name).read_text(encoding="utf-8"), feature_version=(3, 9))
        imported = {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
        imported |= {n.name for node in ast.walk(tree) if isinstance(node, ast.Import) for n in node.names}
        assert {str(name).partition(".")[0] for name in imported} <= {*sys.stdlib_module_names, "numpy", "posegraph"}


@pytest.mark.parametrize(
    ("function", "message"),
    [
        (lambda *_: None, "returned None, expected an array of shape (6,). Is `return` missing?"),
        (lambda *_: "f", "returned str, expected an array of shape (6,)"),
        (lambda x, _: x, "returned shape (5,), expected (6,)"),
        (lambda *_: np.full(6, np.nan), "residual returned nan, expected finite numbers."),
        (lambda *_: 1 / 0, "raised ZeroDivisionError: division by zero (line"),
        (lambda *_: sys.exit(), "raised SystemExit"),
        (lambda *_: np.zeros(6) + 0j, "returned complex numbers, expected real ones"),
        (lambda *_: [[1, 2], [3]], "returned list, expected an array of shape (6,)"),
    ],
    ids=["none", "str", "shape", "nan", "raises", "exits", "complex", "ragged"],
)
def test_odd_values_are_named_once(self_check, capsys, function, message):
    """None, text, a wrong shape, nan, an error and exit() give one FAIL with what came and what was expected."""
    work = {**right_work(), "residual": function}
    ((_line, wrong),) = self_check.failures("residual", work)
    assert message in wrong
    self_check.check("residual", work)
    shown = capsys.readouterr().out
    assert shown.count("FAIL") == 1
    assert "The other checks were not run." in shown


def forward_differences(x, graph, h):
    """J by differences of f."""
    f = slam1d.residual(x, graph)
    return np.array([(slam1d.residual(x + move, graph) - f) / h for move in h * np.eye(len(x))]).T


def damped_equations(J, omega, f):
    """H + 1e-6 I and b."""
    H, b = slam1d.normal_equations(J, omega, f)
    return H + 1e-6 * np.eye(len(b)), b


def damped_step(x, graph):
    """A step of H + 1e-6 I inside a function whose own normal equations are right."""
    J, omega, f = slam1d.jacobian(x, graph), slam1d.information_matrix(graph), slam1d.residual(x, graph)
    H, b = damped_equations(J, omega, f)
    return np.linalg.solve(H, -b)


# What passed every line here and lost points there.
SOFT = {
    "differences_of_1e-8": ("jacobian", lambda x, graph: forward_differences(x, graph, 1e-8)),
    "differences_of_1e-10": ("jacobian", lambda x, graph: forward_differences(x, graph, 1e-10)),
    "rounded_to_8_digits": ("residual", lambda x, graph: np.round(slam1d.residual(x, graph), 8)),
    "rounded_to_4_digits": ("residual", lambda x, graph: np.round(slam1d.residual(x, graph), 4)),
    "masked": ("residual", lambda x, graph: np.ma.masked_array(slam1d.residual(x, graph), False)),
    "damped_by_1e-6": ("normal_equations", damped_equations),
    "step_damped_by_1e-6": ("gauss_newton_step", damped_step),
}


@pytest.mark.parametrize("name", SOFT)
def test_what_the_grader_does_not_let_pass_fails_here(self_check, name):
    """Lost digits, damping and masked arrays fail in their own stage, as they lose its points."""
    stage, function = SOFT[name]
    assert any(wrong for _, wrong in self_check.failures(stage, {**right_work(), stage: function}))


def test_a_missing_return_of_a_pair_is_named(self_check):
    """`normal_equations` without `return` is told so, and a wrong shape says of which of the two."""
    (first, *_) = self_check.failures("normal_equations", {**right_work(), "normal_equations": lambda *_: None})
    assert "normal_equations returned None, expected a tuple of 2 arrays. Is `return` missing?" in first[1]
    turned = {**right_work(), "normal_equations": lambda *given: slam1d.normal_equations(*given)[::-1]}
    assert (
        "H of normal_equations returned shape (2,), expected (2, 2)."
        in self_check.failures("normal_equations", turned)[0][1]
    )


def moved(x, graph):
    """Answer rightly, but move the state itself."""
    dx = slam1d.gauss_newton_step(x, graph)
    x += dx
    return dx


def test_an_argument_changed_in_place_fails(self_check):
    """A step that moves the given x returns the right dx and spoils my_start: it is told so in the grader's words."""
    found = self_check.failures("gauss_newton_step", {**right_work(), "gauss_newton_step": moved})
    assert "gauss_newton_step changes its argument in place; work on a copy" in found[0][1]


@pytest.mark.parametrize(("stage", "slip"), [case for case in all_slips() if case.values[0] == "second_step"])
def test_the_second_step_is_still_checked(self_check, stage, slip):
    """Each known mistake of the second step fails in its own stage, and no message says what right code gives."""
    found = self_check.failures(stage, {**right_work(), "gauss_newton_step": slip.function})
    assert any(wrong for _, wrong in found)
    assert not any(re.search(r"not 0|should be 0|expected (?!\()", wrong) for _, wrong in found)


def test_a_step_that_stays_does_not_lower_the_cost(self_check):
    """A step of zero, or one that swings over to the same cost, is no step down."""
    for name in ("never_moves", "swings_past_the_minimum"):
        found = dict(
            self_check.failures("gauss_newton_step", {**right_work(), "gauss_newton_step": by_identifier(name)})
        )
        assert "the cost was" in found["The step makes the cost lower."]


def test_the_function_to_repair_first_is_named(self_check):
    """Right functions that are checked against a wrong one say which to repair; checks of their own do not."""
    covariance = {**right_work(), "information_matrix": by_identifier("covariance_used_as_information")}
    (own, with_others) = self_check.failures("normal_equations", covariance)
    assert own[1] == ""
    assert with_others[1].endswith(" But information_matrix fails its own check: repair that first.")
    (weight, _) = self_check.failures("information_matrix", covariance)
    assert "weight x variance (the variances themselves stand on the diagonal)" in weight[1]
    assert "repair" not in weight[1]
    turned = {**right_work(), "residual": lambda *given: -slam1d.residual(*given)}
    (sums, derivative) = self_check.failures("jacobian", turned)
    assert sums[1] == ""
    assert derivative[1].endswith(" But residual fails its own check: repair that first.")
    found = self_check.failures("gauss_newton_step", {**right_work(), "jacobian": by_identifier("loop_row_is_zero")})
    assert any("But jacobian fails its own check" in wrong for _, wrong in found)


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
    self_check.check_all({"conclusion": None, "written_2": None, "written_3": "I saw that"})
    shown = capsys.readouterr().out
    assert "TODO  conclusion: it is still None.\nTODO  written_2: it is still None.\nWhat" in shown


def test_wrong_iterates_are_pointed_at(self_check):
    """A row that does not follow from the row before is named, and so is a wrong shape."""
    graph, x = self_check.WORKED, self_check.WORKED.dead_reckoning()
    work = {**right_work(), "__name__": slam1d.__name__, "my_graph": graph, "my_start": x}
    ((_, wrong),) = self_check.failures("iterates", {**work, "iterates": np.array([x, x, x, x])})
    assert "row 1 of iterates, x^(1), is [0 1.1 2.1 3.2 0.5]: it is not row 0 plus your step" in wrong
    ((_, wrong),) = self_check.failures("iterates", {**work, "iterates": np.array([0 * x, x, x, x])})
    assert "row 0 of iterates, x^(0), is [0 0 0 0 0]: it is not dead reckoning" in wrong
    spoilt = x + slam1d.gauss_newton_step(x, graph)  # my_start after a step that changed it in place
    found = self_check.failures("iterates", {**work, "my_start": spoilt, "iterates": np.array([spoilt] * 4)})
    assert "it is not dead reckoning; run the cell of my_start again" in found[0][1]
    ((_, wrong),) = self_check.failures("iterates", {**work, "iterates": np.zeros((2, 5))})
    assert "iterates has shape (2, 5), expected (4, 5)" in wrong


def test_what_may_be_imported_is_what_the_grader_allows(self_check):
    """Students are told the list that holds where the homework is graded."""
    assert set(self_check.ALLOWED.split()) == policy.ALLOWED | policy.STAND_INS


def test_an_import_that_will_not_be_allowed_is_named(self_check, capsys):
    """Modules, and what was taken from them, are named once; own functions and allowed modules are not."""
    namespace = {
        "np": np,
        "subprocess": subprocess,
        "given": hypothesis.given,
        "x": 1,
        "json": json,
        "__name__": __name__,
    }
    assert self_check.foreign(namespace) == ["hypothesis", "subprocess"]
    self_check.check_all(namespace)
    assert "NOTE  subprocess is imported and is not allowed when graded" in capsys.readouterr().out
