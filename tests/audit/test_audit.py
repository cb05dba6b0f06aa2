"""The grader is right about everything whose verdict is known, and the audit says so, or what is wrong."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import pytest

from autograder.attempts import Attempts
from autograder.audit import Audit, audit
from autograder.audit.cases import KINDS, all_cases
from autograder.audit.examine import Examined
from autograder.audit.table import text
from autograder.course import Course
from autograder.engine.collect import collect
from autograder.engine.describe import Describer
from autograder.engine.exam import Exam
from autograder.engine.follow import follow
from autograder.engine.judge import Judge
from autograder.engine.plan import make_plan
from autograder.sandbox.frames import Source
from autograder.sandbox.host import Limits, Sandbox
from autograder.stages.base import Stage
from autograder.stages.catalogue import all_stages, slips
from autograder.stages.gauss_newton_step import GaussNewtonStep
from autograder.stages.residual import Residual


@pytest.mark.slow
def test_every_cell_is_right(found: Audit) -> None:
    """No false alarm, no miss, nothing misjudged: reference, stub, styles, specimens, slips."""
    assert not found.wrong, text(found)
    assert found.clean
    assert {row.kind for row in found.rows} == set(KINDS) - {"hostile"}


@pytest.mark.slow
def test_every_slip_is_a_row_of_the_kill_matrix(found: Audit) -> None:
    """Each slip of each stage is graded as a whole submission, and at least one check catches it."""
    for stage in all_stages():
        rows = found.matrix.get(stage.name, {})
        assert set(rows) == {slip.identifier for slip in slips(stage.name)}
        assert all(any(row) for row in rows.values())
    assert sum(len(rows) for rows in found.matrix.values()) >= 60


@pytest.mark.slow
def test_every_check_has_its_place(found: Audit) -> None:
    """A check catches a slip that no other does, or somebody says why it is kept."""
    assert not found.idle
    assert all(power.caught for power in found.powers)


@pytest.mark.slow
def test_a_clean_audit_is_one_line_and_numbers(found: Audit) -> None:
    """The table counts the right rows and ends with a verdict; JSON holds every cell."""
    shown = text(found)
    assert shown.splitlines()[-1].startswith(f"The exam is sharp: {len(found.rows)} cases, 0 false alarms, 0 misses")
    assert "expected" not in shown.splitlines()[0]
    assert "style_31_matrix.py" not in shown
    assert "style_31_matrix.py" in text(found, verbose=True)
    plain = json.loads(json.dumps(found.plain()))
    assert plain["clean"]
    assert plain["kill_matrix"]["jacobian"]["jacobian_transposed"]["worked_example"]


def in_this_process(
    sources: Sequence[Source],
    stages: Sequence[Stage],
    exam: Exam,
    course: Course,
    _on_done: Any,
    _workers: int | None = None,
) -> Examined:
    """Judge in this process, where a test can blunt a stage; submissions still run in their sandbox."""
    plan = make_plan(stages, {stage.name: course.points[stage.name] for stage in stages}, exam.corpus)
    judge, describer, verdicts = Judge(plan), Describer(plan), []
    with Sandbox(plan.inputs, Limits(cpu_seconds=1.0)) as sandbox:
        for source in sources:
            with sandbox.open(source) as session:
                collected = collect(session, plan)
                follow(session, plan, collected)
                verdicts.append(describer.describe(collected, judge.judge(collected), Attempts()))
        return Examined(verdicts, sandbox.confinement.level)


def audited(*names: str, course: Course | None = None) -> Audit:
    """Audit a few cases by name."""
    return audit(course or Course(), 0, 0, wanted=lambda case: case.name in names, examiner=in_this_process)


def faults(found: Audit) -> set[tuple[str, str]]:
    """Return the stage and the kind of every wrong cell."""
    return {(cell.stage, cell.fault) for row in found.rows for cell in row.wrong}


ROUNDED = ("residual_rounded", "step_rounded", "style_01_list_append.py")


def test_a_few_cases_are_right_in_this_process() -> None:
    """What the tests below blunt is sharp before."""
    assert not audited(*ROUNDED).wrong


def test_a_widened_tolerance_is_a_miss(monkeypatch: pytest.MonkeyPatch) -> None:
    """An exam that accepts four decimals fails its audit at the stage that was blunted.

    Whoever passes there is not asked for the step by itself, and loses there what the residual should have cost.
    """
    tolerance = Residual.tolerance
    monkeypatch.setattr(Residual, "tolerance", lambda self, x, graph: (1e6 * tolerance(self, x, graph)[0],))
    found = audited(*ROUNDED)
    steps = {("gauss_newton_step", "false alarm"), ("second_step", "false alarm")}
    assert faults(found) == {("residual", "miss"), *steps}
    shown = text(found)
    assert "The exam is not sharp: 3 cases, 2 false alarms, 1 misses" in shown
    assert "miss: a wrong answer passes" in shown
    assert "The grader itself, not a setting" in shown
    assert not found.clean


def test_a_narrowed_tolerance_is_a_false_alarm(monkeypatch: pytest.MonkeyPatch) -> None:
    """An exam that takes rounding for a mistake fails its audit on a correct style."""
    monkeypatch.setattr("autograder.stages.gauss_newton_step.BACKWARD_ERROR", 1e-18)
    assert ("gauss_newton_step", "false alarm") in faults(audited("style_03_inv.py"))


def test_a_stage_that_accepts_everything_is_a_miss(monkeypatch: pytest.MonkeyPatch) -> None:
    """A judge that says yes to all is noticed by each slip of its stage."""
    monkeypatch.setattr(GaussNewtonStep, "judge", lambda _self, _prepared, answers, _again=None: answers.outcome == 0)
    found = audited("step_half_as_long", "step_damped")
    assert faults(found) == {("gauss_newton_step", "miss")}
    assert not any(any(row) for row in found.matrix["gauss_newton_step"].values())


def test_an_exam_of_nice_numbers_is_blunt(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without the rungs of real numbers and of a hundred poses, rounding is not seen, and the audit says it."""
    kept = tuple(rung for rung in Residual.ladder.rungs if rung.name not in ("real_valued", "many_poses"))
    course = Course(stages=("residual",))
    assert not faults(audited("residual_rounded", course=course))
    monkeypatch.setattr(Residual, "ladder", replace(Residual.ladder, rungs=kept))
    assert faults(audited("residual_rounded", course=course)) == {("residual", "miss")}


def test_a_check_without_a_reason_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    """A check that catches nothing alone and has no reason beside it makes the exam not sharp."""
    bare = tuple(replace(rung, reason="") for rung in Residual.ladder.rungs)
    monkeypatch.setattr(Residual, "ladder", replace(Residual.ladder, rungs=bare))
    found = audited("residual_squared", course=Course(stages=("residual",)))
    assert (found.wrong, found.clean) == ((), False)
    assert "residual, variances: catches nothing alone, and nobody says why it is kept." in text(found)


def test_a_course_with_fewer_stages_is_audited_on_these() -> None:
    """Slips of stages that are not used are no cases, and cells of other stages are not asked for."""
    used = tuple(stage for stage in all_stages() if stage.name in ("residual", "jacobian"))
    kinds = {case.slip_of for case in all_cases(used)}
    assert kinds == {"", "residual", "jacobian"}
