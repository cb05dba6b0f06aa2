"""Whole submissions in a real sandbox: what is right earns full points, what is wrong costs itself alone."""

import numpy as np
import pytest

from assignment.posegraph import PoseGraph
from autograder.stages.catalogue import all_stages, slips
from autograder.stages.slips.submission import submission_text
from reference_solution import slam1d
from tests.engine.conftest import REFERENCE

STAGES = [stage.name for stage in all_stages()]
TOTAL = sum(stage.points for stage in all_stages() if not stage.bonus)


def changed(old, new, text=REFERENCE):
    """Return the reference with one piece of text replaced."""
    assert old in text
    return text.replace(old, new)


def statuses(verdicts):
    """Return the status of every stage."""
    return {name: verdict.status for name, verdict in verdicts.items()}


def total(verdicts):
    """Add up the scores of the stages that are no bonus."""
    return sum(verdict.score for verdict in verdicts.values() if not verdict.bonus)


def test_the_reference_has_full_marks(grade_source):
    """Every stage of the reference is passed, without a remark."""
    verdicts = grade_source(REFERENCE)
    assert set(statuses(verdicts).values()) == {"passed"}
    assert total(verdicts) == TOTAL
    assert not any(verdict.remarks for verdict in verdicts.values())


def test_the_reference_in_cells_has_full_marks(grade_source):
    """A notebook is graded as a module is, with magics and plots around the functions."""
    parts = REFERENCE.split("\n\n\ndef ")
    cells = ["%matplotlib inline\nimport matplotlib.pyplot as plt", parts[0], *(f"def {part}" for part in parts[1:])]
    cells.append("fig, ax = plt.subplots()\nax.plot([1, 2])\nget_ipython().run_line_magic('time', '')\n!ls")
    assert set(statuses(grade_source(cells, "notebook")).values()) == {"passed"}


def test_an_empty_submission_has_nothing(grade_source):
    """No function: every stage is missing and earns 0."""
    verdicts = grade_source("x = 1\n")
    assert set(statuses(verdicts).values()) == {"missing"}
    assert total(verdicts) == 0


def test_an_unfinished_function_is_missing(grade_source):
    """A stub that raises NotImplementedError is unfinished, not wrong."""
    text = REFERENCE + "\n\ndef jacobian(x, graph):\n    raise NotImplementedError('fill me in')\n"
    verdicts = grade_source(text)
    assert verdicts["jacobian"].status == "missing"
    assert verdicts["residual"].status == "passed"


def test_covariance_for_information_costs_that_stage_alone(grade_source):
    """The mistake is named once; the step that follows from it earns the follow-through share."""
    verdicts = grade_source(changed("1.0 / variances", "variances"))
    assert verdicts["information_matrix"].slip == "covariance_used_as_information"
    assert verdicts["information_matrix"].score == 0
    assert verdicts["gauss_newton_step"].status == "partial"
    assert verdicts["gauss_newton_step"].message.startswith("Mend information_matrix first")
    assert total(verdicts) == TOTAL - verdicts["information_matrix"].max_score
    assert {verdicts[name].status for name in ("residual", "jacobian", "normal_equations")} == {"passed"}


EQUIVALENT = {
    "signs": [
        ("between = x[i] + graph.measurements - x[j]", "between = x[j] - x[i] - graph.measurements"),
        ("J[np.arange(k), i] = 1.0", "J[np.arange(k), i] = -1.0"),
        ("J[np.arange(k), j] = -1.0", "J[np.arange(k), j] = 1.0"),
    ],
    "order": [
        ("np.concatenate([between, prior])", "np.concatenate([prior, between])"),
        ("    return J\n", "    return np.roll(J, len(graph.priors), axis=0)\n"),
        ("[graph.edge_variances, graph.prior_variances]", "[graph.prior_variances, graph.edge_variances]"),
    ],
}


@pytest.mark.parametrize("name", EQUIVALENT)
def test_an_equivalent_convention_keeps_its_points(grade_source, name):
    """Rows in another order, or with the other sign in f and J, are the same least squares: full marks, a remark."""
    text = REFERENCE
    for old, new in EQUIVALENT[name]:
        text = changed(old, new, text)
    verdicts = grade_source(text)
    assert total(verdicts) == TOTAL
    assert all("equivalent convention" in verdicts[stage].remarks[0] for stage in STAGES[:3])


@pytest.mark.parametrize("name", EQUIVALENT)
def test_a_convention_that_is_not_kept_is_a_mistake(grade_source, name):
    """With one of the three functions left as it was, the rows do not fit together and each is judged alone."""
    text = REFERENCE
    for old, new in EQUIVALENT[name][:-1]:
        text = changed(old, new, text)
    verdicts = grade_source(text)
    assert any(verdicts[stage].status in {"failed", "partial"} for stage in STAGES[:3])


def test_an_endless_loop_costs_its_stage_alone(grade_source):
    """The next stages go on in a fresh child."""
    text = REFERENCE + "\n\ndef normal_equations(J, omega, f):\n    while True:\n        pass\n"
    text += "\n\ndef gauss_newton_step(x, graph):\n    J, W = jacobian(x, graph), information_matrix(graph)\n"
    text += "    return np.linalg.solve(J.T @ W @ J, -J.T @ W @ residual(x, graph))\n"
    verdicts = grade_source(text)
    assert verdicts["normal_equations"].status == "timeout"
    assert "longer than 0.5 s" in verdicts["normal_equations"].message
    assert total(verdicts) == TOTAL - verdicts["normal_equations"].max_score


ENDINGS = {
    "ends the process": ("    import os\n    os._exit(0)\n", "error"),
    "fills the memory": ("    return np.ones(10**9) @ np.ones(10**9)\n", "memory"),
    "raises": ("    raise ValueError('no idea')\n", "error"),
    "exits": ("    import sys\n    sys.exit(0)\n", "error"),
    "uses scipy": ("    import scipy\n    return scipy.linalg.inv(graph)\n", "forbidden"),
    "returns None": ("    return None\n", "failed"),
    "returns a string": ("    return 'f'\n", "failed"),
    "returns complex": ("    return (1 + 0j) * x\n", "failed"),
    "returns objects": ("    return np.array([object()])\n", "failed"),
    "returns a generator": ("    return (v for v in x)\n", "failed"),
    "returns nan": ("    return np.full(graph.n_factors, np.nan)\n", "failed"),
    "returns inf": ("    return np.full(graph.n_factors, np.inf)\n", "failed"),
    "returns a wrong shape": ("    return np.zeros((2, 2))\n", "failed"),
    "returns far too much": ("    return np.zeros(10**6)\n", "failed"),
}


@pytest.mark.parametrize("name", ENDINGS)
def test_odd_ends_are_named_and_cost_themselves_alone(grade_source, name):
    """Whatever `residual` does, its stage says what came and the others are graded."""
    body, status = ENDINGS[name]
    verdicts = grade_source(REFERENCE + f"\n\ndef residual(x, graph):\n{body}")
    assert verdicts["residual"].status == status
    assert verdicts["residual"].score == 0
    assert verdicts["residual"].message.endswith(".")
    assert {verdicts[stage].status for stage in ("jacobian", "information_matrix", "normal_equations")} == {"passed"}


REMARKED = {
    "list": ("residual", "f.tolist()", "returns a list"),
    "column": ("residual", "f[:, None]", "returns a column or a row"),
    "matrix": ("residual", "np.matrix(f)", "np.matrix"),
    "in place": ("residual", "(f, x.fill(0))[0]", "in place"),
}


@pytest.mark.parametrize("name", REMARKED)
def test_style_costs_nothing_but_a_remark(grade_source, name):
    """Lists, columns, np.matrix and changed arguments keep all points."""
    stage, value, words = REMARKED[name]
    text = (
        REFERENCE + f"\n\n_right = residual\n\ndef residual(x, graph):\n    f = _right(x, graph)\n    return {value}\n"
    )
    verdicts = grade_source(text)
    assert verdicts[stage].status == "passed"
    assert any(words in remark for remark in verdicts[stage].remarks)


@pytest.mark.parametrize("slip", slips("jacobian"), ids=lambda slip: slip.identifier)
def test_a_known_mistake_is_named_at_its_stage(grade_source, slip):
    """Each slip of the Jacobian fails `jacobian` alone of the first four stages, and under its own name."""
    verdicts = grade_source(submission_text(slip, "jacobian"))
    assert verdicts["jacobian"].slip == slip.identifier
    assert verdicts["jacobian"].hint == slip.hint
    assert verdicts["jacobian"].group
    assert {verdicts[name].status for name in ("residual", "information_matrix", "normal_equations")} == {"passed"}


def test_the_counterexample_is_small_and_complete(grade_source):
    """A failed check shows a graph, a state, what came and what was expected, as plain data."""
    verdict = grade_source(changed("x[i] + graph.measurements - x[j]", "x[i] - x[j]"))["residual"]
    shown = next(check for check in verdict.checks if not check.passed).counterexample
    assert shown["graph"]["n_poses"] <= 5
    assert len(shown["got"]) == len(shown["expected"])
    assert shown["got"] != shown["expected"]


def test_each_function_of_a_stage_is_asked_whether_or_not_the_other_is_there(grade_source):
    """range_jacobian alone earns its own share of the stage."""
    text = REFERENCE + "\n\ndel range_residual\n"
    verdict = grade_source(text)["range_factor"]
    assert {check.name: check.passed for check in verdict.checks} == {"distances": False, "derivatives": True}
    assert verdict.checks[0].message.startswith("range_residual is no")


def test_what_is_wrong_in_the_second_round_is_shown_there(grade_source):
    """A step that gives nothing at the minimum is said to, with the call that was made there."""
    text = REFERENCE + (
        "\n\n_step = gauss_newton_step\n\ndef gauss_newton_step(x, graph):\n    dx = _step(x, graph)\n"
        "    return None if np.abs(dx).max() < 1e-6 else dx\n"
    )
    verdict = grade_source(text)["second_step"]
    check = next(check for check in verdict.checks if not check.passed)
    expected = "expected an array of real numbers, shape (5,)."
    assert check.message == f"gauss_newton_step(x + dx(x), graph) returned None; {expected}"
    shown = check.counterexample
    graph = PoseGraph(**shown["graph"])
    assert np.abs(slam1d.gauss_newton_step(np.array(shown["x"]), graph)).max() < 1e-6
    assert shown["got"] == "None"
