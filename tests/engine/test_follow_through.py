"""Follow-through: who solves the own equations earns the share, and a trivial earlier answer buys nothing."""

from __future__ import annotations

from dataclasses import replace

import pytest

from autograder.engine.collect import collect
from autograder.engine.judge import Judge
from autograder.sandbox.frames import Source
from autograder.sandbox.host import Limits, Sandbox
from tests.engine.conftest import REFERENCE

COVARIANCE = REFERENCE.replace("1.0 / variances", "variances")


def step(grade_source, text):
    """Grade a submission and return the verdict on its step."""
    return grade_source(text)["gauss_newton_step"]


def test_every_failed_check_earns_the_share_and_no_more(grade_source):
    """A passed check has its points, a check that follows has half of them, and the stage adds them up."""
    verdict = step(grade_source, COVARIANCE)
    assert {check.points / check.max_points for check in verdict.checks} == {0.5, 1.0}
    assert verdict.score == sum(check.points for check in verdict.checks)
    for check in verdict.checks:
        assert check.passed == (check.points == check.max_points)
        assert check.passed or "your own H dx = -b" in check.message


@pytest.mark.parametrize("share", [0.0, 0.25, 1.0])
def test_the_share_is_the_course_s(plan, share):
    """The share that the course sets is what a check that follows earns; such a check is still not passed."""
    source = Source("module", [COVARIANCE], "submission.py")
    with Sandbox(plan.inputs, Limits(cpu_seconds=0.5)) as sandbox, sandbox.open(source) as session:
        collected = collect(session, plan)
    verdicts = Judge(replace(plan, follow_through=share)).judge(collected)
    (verdict,) = [verdict for verdict in verdicts if verdict.name == "gauss_newton_step"]
    open_checks = [check for check in verdict.checks if not check.passed]
    assert open_checks
    assert {check.points / check.max_points for check in open_checks} == {share}
    assert verdict.status == "partial"


def test_a_right_step_has_full_points_whatever_failed_before(grade_source):
    """A step that does not use the wrong function costs nothing."""
    text = REFERENCE + (
        "\n\n_right = information_matrix\n"
        "_solve = gauss_newton_step\n"
        "\n\ndef gauss_newton_step(x, graph):\n"
        "    f, J, W = residual(x, graph), jacobian(x, graph), _right(graph)\n"
        "    return np.linalg.solve(J.T @ W @ J, -J.T @ W @ f)\n"
        "\n\ndef information_matrix(graph):\n    return 2 * _right(graph)\n"
    )
    verdict = step(grade_source, text)
    assert (verdict.status, verdict.score) == ("passed", verdict.max_score)


NOT_FOLLOWING = {
    "a damped step": "\n\ndef gauss_newton_step(x, graph):\n"
    "    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))\n"
    "    return np.linalg.solve(H + 1e-2 * np.eye(len(b)), -b)\n",
    "half a step": "\n\n_whole = gauss_newton_step\n\n\ndef gauss_newton_step(x, graph):\n"
    "    return 0.5 * _whole(x, graph)\n",
    "no step": "\n\ndef gauss_newton_step(x, graph):\n    return np.zeros(graph.n_poses)\n",
    "minus x": "\n\ndef gauss_newton_step(x, graph):\n    return -x\n",
}


@pytest.mark.parametrize("name", NOT_FOLLOWING)
def test_a_step_that_is_wrong_by_itself_earns_nothing_more(grade_source, name):
    """A second mistake, in the step, is not paid for by the first one, in Omega."""
    verdict = step(grade_source, COVARIANCE + NOT_FOLLOWING[name])
    assert all(check.points == 0 for check in verdict.checks if not check.passed)
    assert verdict.score <= 2.0  # where all weights are equal, nothing shows


ZERO_STEP = "\n\ndef gauss_newton_step(x, graph):\n    return np.zeros(graph.n_poses)\n"
TRAPS = {
    "f is zero, and so is the step": "\n\ndef residual(x, graph):\n    return np.zeros(graph.n_factors)\n" + ZERO_STEP,
    "b is zero, and so is the step": "\n\ndef normal_equations(J, omega, f):\n"
    "    return J.T @ omega @ J, np.zeros(J.shape[1])\n" + ZERO_STEP,
    "f hears no measurement, and the step is minus x": "\n\ndef residual(x, graph):\n"
    "    return jacobian(x, graph) @ x\n"
    "\n\ndef gauss_newton_step(x, graph):\n    return -x\n",
    "J is the identity, and the step is minus f": "\n\ndef jacobian(x, graph):\n"
    "    return np.eye(graph.n_factors, graph.n_poses)\n"
    "\n\ndef gauss_newton_step(x, graph):\n    return -residual(x, graph)[: graph.n_poses]\n",
    "H is its diagonal, and the step divides": "\n\ndef normal_equations(J, omega, f):\n"
    "    return np.diag(np.diag(J.T @ omega @ J)), J.T @ omega @ f\n",
    "H is not symmetric": "\n\ndef normal_equations(J, omega, f):\n"
    "    return np.triu(J.T @ omega @ J), J.T @ omega @ f\n",
    "H is negative": "\n\ndef normal_equations(J, omega, f):\n    return -J.T @ omega @ J, J.T @ omega @ f\n",
    "Omega is zero": "\n\ndef information_matrix(graph):\n    return np.zeros((graph.n_factors, graph.n_factors))\n"
    + ZERO_STEP,
    "b remembers the step": "\n\n_last = {}\n\n\ndef normal_equations(J, omega, f):\n"
    "    H = J.T @ omega @ J\n    dx = _last.get(len(H), np.ones(len(H)))\n    return H, -H @ dx\n"
    "\n\ndef gauss_newton_step(x, graph):\n"
    "    _last[graph.n_poses] = 0.5 * x\n    return 0.5 * x\n",
}


@pytest.mark.parametrize("name", TRAPS)
def test_a_trivial_earlier_answer_buys_nothing(grade_source, name):
    """An earlier function that makes the step trivial, or that learns from it, earns no follow-through."""
    assert step(grade_source, REFERENCE + TRAPS[name]).score == 0
