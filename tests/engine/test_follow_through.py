"""A mistake is paid for once: what is right by itself keeps its points, and nothing else is won by it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from autograder.engine.collect import collect
from autograder.engine.follow import EARLIER, follow, wanted
from autograder.engine.judge import Judge
from autograder.problems.apart import structure
from autograder.problems.graphs import well_posed
from autograder.sandbox.frames import Source
from autograder.sandbox.host import Limits, Sandbox
from autograder.stages.catalogue import all_stages
from autograder.stages.earlier import answers
from reference_solution import slam1d
from tests.engine.conftest import REFERENCE

COVARIANCE = REFERENCE.replace("1.0 / variances", "variances")
STEPS = ("gauss_newton_step", "second_step")
BROKEN = {
    "residual": "def residual(x, graph):\n    return np.zeros(graph.n_factors) + x[0]\n",
    "jacobian": "def jacobian(x, graph):\n    return np.eye(graph.n_factors, graph.n_poses)\n",
    "information_matrix": "def information_matrix(graph):\n    return 1.0 / graph.edge_variances\n",
    "normal_equations": "def normal_equations(J, omega, f):\n    return J.T @ omega @ f, J.T @ omega @ J\n",
}
NO_STEP = "\n\ndef gauss_newton_step(x, graph):\n    raise NotImplementedError\n"


def appended(*texts: str) -> str:
    """Write the reference with other definitions after it."""
    return "\n\n".join((REFERENCE, *texts))


def scores(verdicts) -> dict[str, float]:
    """Return what each stage that is no bonus earned, as a share of its points."""
    return {name: each.score / each.max_score for name, each in verdicts.items() if not each.bonus}


@pytest.mark.parametrize("name", BROKEN)
def test_a_wrong_function_costs_its_own_stage(grade_source, name):
    """The step is right by itself, in both of its stages, and says what to mend first."""
    verdicts = grade_source(appended(BROKEN[name]))
    assert scores(verdicts) == {each: float(each != name) for each in scores(verdicts)} | {name: scores(verdicts)[name]}
    assert scores(verdicts)[name] < 1
    for step in STEPS:
        if verdicts[step].status != "passed":
            assert verdicts[step].status == "partial"
            assert verdicts[step].message.startswith(
                f"Mend {name} first, which the step builds on. The step keeps its points: it was asked again"
            )
            assert "Right by itself; with your own functions: " in verdicts[step].message


def test_all_earlier_functions_may_be_wrong_or_missing(grade_source):
    """Whoever wrote the step alone has its points, and no others."""
    verdicts = grade_source(appended(*BROKEN.values()))
    assert [verdicts[step].score for step in STEPS] == [verdicts[step].max_score for step in STEPS]
    written = REFERENCE[REFERENCE.index("def gauss_newton_step") : REFERENCE.index("def sparsity_pattern")]
    verdicts = grade_source("from __future__ import annotations\n\nimport numpy as np\n\n\n" + written)
    assert {name: each.status for name, each in verdicts.items() if name in EARLIER} == dict.fromkeys(
        EARLIER, "missing"
    )
    assert [verdicts[step].score for step in STEPS] == [verdicts[step].max_score for step in STEPS]


def judged(plan, text, seconds=0.5):
    """Judge a submission that runs alone: the clock is believed, however busy the machine is."""
    source = Source("module", [text], "submission.py")
    with Sandbox(plan.inputs, Limits(cpu_seconds=seconds)) as sandbox, sandbox.open(source) as session:
        collected = collect(session, plan, alone=True)
        follow(session, plan, collected)
    return {verdict.name: verdict for verdict in Judge(plan).judge(collected)}


def test_a_function_that_hangs_costs_its_own_stage(plan):
    """The step waits for it with the student's own functions, and by itself it does not."""
    verdicts = judged(plan, appended("def jacobian(x, graph):\n    while True:\n        pass\n"))
    assert verdicts["jacobian"].status == "timeout"
    assert scores(verdicts) == {name: float(name != "jacobian") for name in scores(verdicts)}


@pytest.mark.parametrize("share", [0.0, 0.25, 1.0])
def test_the_share_is_the_course_s(plan, share):
    """The share that the course sets is what a check by itself earns; such a check is still not passed."""
    verdict = judged(replace(plan, follow_through=share), COVARIANCE)["gauss_newton_step"]
    open_checks = [check for check in verdict.checks if not check.passed]
    assert {check.points / check.max_points for check in open_checks} == {share}
    assert verdict.status == "partial"
    assert verdict.message.startswith("Mend information_matrix first")


def test_a_right_step_has_full_points_whatever_failed_before(grade_source):
    """A step that does not use the wrong function is passed, and not asked again."""
    text = (
        "_right = information_matrix",
        (
            "def gauss_newton_step(x, graph):\n"
            "    f, J, W = residual(x, graph), jacobian(x, graph), _right(graph)\n"
            "    return np.linalg.solve(J.T @ W @ J, -J.T @ W @ f)"
        ),
        "def information_matrix(graph):\n    return 2 * _right(graph)",
    )
    verdict = grade_source(appended(*text))["gauss_newton_step"]
    assert (verdict.status, verdict.score) == ("passed", verdict.max_score)


FORMS = {
    "columns": "_f = residual\n\n\ndef residual(x, graph):\n    return 2 * _f(x, graph)[:, None]\n\n\n"
    "def gauss_newton_step(x, graph):\n"
    "    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))\n"
    "    return np.linalg.solve(H, -b)[:, 0]\n",
    "np.matrix": "_f, _J, _W = residual, jacobian, information_matrix\n\n\n"
    "def residual(x, graph):\n    return np.matrix(2 * _f(x, graph)).T\n\n\n"
    "def jacobian(x, graph):\n    return np.matrix(_J(x, graph))\n\n\n"
    "def information_matrix(graph):\n    return np.matrix(_W(graph))\n\n\n"
    "def gauss_newton_step(x, graph):\n"
    "    J, W, f = jacobian(x, graph), information_matrix(graph), residual(x, graph)\n"
    "    return np.asarray((J.T * W * J).I * -(J.T * W * f)).ravel()\n",
    "lists": "_f = residual\n\n\ndef residual(x, graph):\n    return [2 * value for value in _f(x, graph)]\n\n\n"
    "def gauss_newton_step(x, graph):\n"
    "    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), np.array(residual(x, graph) + []))\n"
    "    return np.linalg.solve(H, -b)\n",
    "other names": "def residual(x, graph):\n    return np.zeros(graph.n_factors)\n\n\n"
    "r, solver = residual, {'H': normal_equations}\n\n\n"
    "def gauss_newton_step(x, graph, J=jacobian):\n"
    "    H, b = solver['H'](f=r(x, graph), J=J(x, graph), omega=information_matrix(graph))\n"
    "    return np.linalg.solve(H, -b)\n",
    "inside the step": "def residual(x, graph):\n    return np.zeros(graph.n_factors)\n\n\n"
    "def gauss_newton_step(x, graph):\n"
    "    f, J, W = residual(x, graph), jacobian(x, graph), information_matrix(graph)\n"
    "    return np.linalg.lstsq(np.sqrt(W) @ J, -np.sqrt(W) @ f, rcond=None)[0]\n",
}


@pytest.mark.parametrize("name", FORMS)
def test_the_right_functions_answer_in_the_student_s_own_form(grade_source, name):
    """A step that counts on columns, on np.matrix or on lists, or calls by other names, is right by itself."""
    verdicts = grade_source(appended(FORMS[name]))
    assert verdicts["residual"].score == 0
    assert [verdicts[step].score for step in STEPS] == [verdicts[step].max_score for step in STEPS]


WRONG_STEPS = {
    "a damped step": "    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))\n"
    "    return np.linalg.solve(H + 1e-2 * np.eye(len(b)) * H.max(), -b)",
    "half a step": "    return 0.5 * _whole(x, graph)",
    "no step": "    return np.zeros(graph.n_poses)",
    "minus x": "    return -x",
    "the sum of the measurements minus x": "    return graph.measurements.sum() - x",
    "dead reckoning minus x": "    return graph.dead_reckoning() - x",
    "the right step once": "    _seen.append(1)\n    return _whole(x, graph) if len(_seen) < 3 else 0 * x",
    "minus f": "    return -residual(x, graph)[: graph.n_poses]",
    "minus b over the diagonal": "    J, W, f = jacobian(x, graph), information_matrix(graph), residual(x, graph)\n"
    "    H, b = normal_equations(J, W, f)\n"
    "    return -b / np.diag(H)",
}


@pytest.mark.parametrize("name", WRONG_STEPS)
@pytest.mark.parametrize("broken", [("jacobian",), tuple(BROKEN)], ids=["one", "all"])
def test_a_step_that_is_wrong_by_itself_earns_nothing(grade_source, name, broken):
    """A second mistake, in the step, is not paid for by the first one, whatever the other functions answer."""
    step = f"_whole, _seen = gauss_newton_step, []\n\n\ndef gauss_newton_step(x, graph):\n{WRONG_STEPS[name]}\n"
    verdicts = grade_source(appended(step, *(BROKEN[each] for each in broken)))
    assert [verdicts[each].score for each in STEPS] == [0, 0]


def test_an_unfinished_step_is_missing(grade_source):
    """A step that is not written is asked again, and still missing."""
    verdict = grade_source(appended(BROKEN["jacobian"], NO_STEP))["gauss_newton_step"]
    assert (verdict.status, verdict.score) == ("missing", 0)


def test_nobody_right_is_asked_again(plan):
    """Neither the reference nor a step that is wrong where all before it is right costs another child."""
    for text in (REFERENCE, appended("def gauss_newton_step(x, graph):\n    return -x\n")):
        with (
            Sandbox(plan.inputs, Limits(cpu_seconds=0.5)) as sandbox,
            sandbox.open(Source("module", [text], "submission.py")) as session,
        ):
            assert wanted(plan, collect(session, plan)) == []


def graphs_of(tasks):
    """Return all graphs that some checks hand over, with the states."""
    return [call for task in tasks for case in task.cases for call in task.stage.calls(case) if len(call) == 2]


def test_the_graphs_kept_apart_are_used_nowhere_else(plan):
    """No graph of the exam or of the gallery is among them; none of the exam has the J, Omega or f of one of them."""
    exam = [(x, graph) for x, graph in graphs_of(plan.tasks) if hasattr(graph, "priors")]
    shown = [(x, graph) for x, graph in graphs_of(plan.galleries) if hasattr(graph, "priors")]
    mine = graphs_of(plan.apart)
    assert not {graph for _, graph in mine} & {graph for _, graph in (*exam, *shown)}
    assert not {structure(graph) for _, graph in mine} & {structure(graph) for _, graph in exam}
    given = {
        array.tobytes()
        for table in answers(tuple({graph for _, graph in mine}))
        for _, parts in table.rows
        for part in parts
        for array in part
        if array is not None and array.any()
    }
    for x, graph in exam:
        J, omega, f = slam1d.jacobian(x, graph), slam1d.information_matrix(graph), slam1d.residual(x, graph)
        H, b = slam1d.normal_equations(J, omega, f)
        for answer in (J, omega, f, f - J @ x, H, b, slam1d.gauss_newton_step(x, graph)):
            assert not answer.any() or answer.tobytes() not in given


def test_the_graphs_kept_apart_are_within_the_contract(plan):
    """Each check has such cases, all well posed, and the reference is right on them."""
    for task in plan.apart:
        assert task.cases
        assert all(well_posed(x, graph) for x, graph in task.cases)
    assert {(task.stage.name, task.rung.name) for task in plan.apart} == {
        (stage.name, rung.name) for stage in all_stages() if stage.name in STEPS for rung in stage.ladder.rungs
    }


def test_the_tables_answer_as_the_equations_say(plan):
    """What stands in for a function is its answer on these graphs: J x + c, J, Omega, H, and b for every f."""
    calls = graphs_of(plan.apart)
    f, J, omega, equations = answers(tuple(dict.fromkeys(graph for _, graph in calls)))
    found = {table.function: dict(zip([row[0][0] for row in table.rows], table.rows, strict=True)) for table in (f, J)}
    for x, graph in calls[:: len(calls) // 50]:
        (constant, factor) = found["residual"][graph][1][0]
        i, j = graph.edges.T
        by_hand = np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])
        assert constant + factor @ x == pytest.approx(by_hand, abs=1e-9)
    for (J_given, omega_given), ((given, _), (nothing, to_b)) in equations.rows:
        v = np.arange(len(omega_given), dtype=float)
        weighted = list(zip(np.diag(omega_given), J_given, v, strict=True))
        by_rows = sum(w * np.outer(row, row) for w, row, _ in weighted)
        assert given == pytest.approx(by_rows)
        assert nothing + to_b @ v == pytest.approx(sum(w * row * e for w, row, e in weighted))
