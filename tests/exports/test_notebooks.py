"""The notebooks for other graders: the hidden tests judge as we do, and the formats are what those systems read."""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import nbformat
import pytest

from assignment import posegraph
from autograder.course import load_course
from autograder.errors import UsageError
from autograder.exports.nbgrader.course import source_notebook
from autograder.exports.nbgrader.feedback import feedback_tree
from autograder.exports.notebooks.questions import Question, answer_code, questions
from autograder.exports.otter.master import master_notebook
from autograder.problems.problem import worked_problem
from autograder.render.stub import stub_module
from autograder.stages.catalogue import slips, stage
from autograder.stages.slips.submission import submission_text
from reference_solution import slam1d
from tests.reports.examples import result

COURSE = load_course(None)
REFERENCE = Path(slam1d.__file__).read_text(encoding="utf-8")
GRADED = ("residual", "jacobian", "information_matrix", "normal_equations", "gauss_newton_step", "second_step")
Run = Callable[..., tuple[int, str, str]]


@pytest.fixture(scope="module")
def asked() -> tuple[Question, ...]:
    """The questions of a course with default settings."""
    return questions(COURSE.points, COURSE.stages, worked_problem())


@pytest.fixture(autouse=True)
def _flat(monkeypatch: pytest.MonkeyPatch) -> None:
    """`posegraph` and `self_check` are importable as they are beside a notebook."""
    monkeypatch.setitem(sys.modules, "posegraph", posegraph)


def namespace(text: str, **more: Any) -> dict[str, Any]:
    """Run a submission, as a kernel would."""
    module = ModuleType("slam1d")
    exec(compile(text, "slam1d.py", "exec"), module.__dict__)
    return {**module.__dict__, **more}


def passed(questions: tuple[Question, ...], work: dict[str, Any]) -> set[str]:
    """Run every hidden test in the process of the work, as other graders do; name those that pass."""
    found = set()
    for question in questions:
        for check in question.checks:
            try:
                exec(compile(check.code, check.identifier, "exec"), dict(work))
            except (AssertionError, NotImplementedError, TypeError, ValueError, IndexError):
                continue
            found.add(check.identifier)
    return found


def answered(text: str) -> dict[str, Any]:
    """Run a submission and the code that answers questions 2 and 3."""
    problem = worked_problem()
    work = namespace(text, my_graph=problem.graph, my_start=problem.start)
    for code in answer_code(problem).values():
        exec(code, work)
    return work


def test_the_reference_passes_and_the_stub_does_not(asked: tuple[Question, ...]) -> None:
    """Full points for the one, none for the other."""
    everything = {check.identifier for question in asked for check in question.checks}
    assert passed(asked, answered(REFERENCE)) == everything
    assert passed(asked, namespace(stub_module(worked_problem()))) == set()


@pytest.mark.slow
@pytest.mark.parametrize("name", GRADED)
def test_every_slip_fails_at_its_stage(asked: tuple[Question, ...], name: str) -> None:
    """Each known mistake fails a hidden test of its own stage: the hand-picked cases are enough."""
    own = tuple(question for question in asked if question.stage == name)
    missed = []
    for slip in slips(name):
        work = namespace(submission_text(slip, stage(name).function))
        if len(passed(own, work)) == len(own[0].checks):
            missed.append(slip.identifier)
    assert missed == []


def test_points_are_those_of_the_course_file(asked: tuple[Question, ...]) -> None:
    """The tests of a stage add up to its points, whatever these are."""
    found: dict[str, float] = {}
    for question in asked:
        found[question.stage] = found.get(question.stage, 0) + question.points
    assert found == {name: COURSE.points[name] for name in (*GRADED, "answers")}
    other = questions({**COURSE.points, "jacobian": 7.0}, ("jacobian",), worked_problem())
    assert [(question.stage, question.points) for question in other] == [("jacobian", 7.0)]


def test_the_source_notebook_is_schema_3() -> None:
    """Every marked cell has what nbgrader asks for: the keys, an id of its own, points where it is graded."""
    notebook = nbformat.reads(source_notebook(COURSE.points, COURSE.stages, worked_problem()), as_version=4)
    marks = [(cell, cell.metadata["nbgrader"]) for cell in notebook.cells if "nbgrader" in cell.metadata]
    names = [mark["grade_id"] for _, mark in marks]
    assert len(names) == len(set(names))
    assert all(re.fullmatch(r"[a-zA-Z0-9_\-]+", name) for name in names)
    for cell, mark in marks:
        assert set(mark) - {"points"} == {"schema_version", "grade_id", "grade", "solution", "locked", "task"}
        assert ("points" in mark) == mark["grade"]
        assert cell.cell_type == "code" or mark["grade"] == mark["solution"]
        assert cell.source.count("### BEGIN") == cell.source.count("### END") <= 1
        if cell.cell_type == "code":
            ast.parse(cell.source)
    total = sum(mark.get("points", 0) for _, mark in marks)
    assert total == sum(COURSE.points[name] for name in (*GRADED, "answers", "written")) == 100


def test_answers_stand_between_the_delimiters_only() -> None:
    """What nbgrader does not remove holds no line of the solution and no hidden case."""
    text = source_notebook(COURSE.points, COURSE.stages, worked_problem())
    kept = ""
    for cell in nbformat.reads(text, as_version=4).cells:
        kept += re.sub(r"### BEGIN (\w+).*?### END \1", "", cell.source, flags=re.DOTALL)
    for secret in ("J.T @ omega", "judge_", "DATA", "EXPECTED", "conclusion = '", "SOLUTION.md"):
        assert secret in text, secret
        assert secret not in kept, secret


def test_otters_raw_cells_are_balanced() -> None:
    """Every block is opened and closed in order, every question has points, every test is one function."""
    notebook = nbformat.reads(master_notebook(COURSE.points, COURSE.stages, worked_problem()), as_version=4)
    raw = [cell.source for cell in notebook.cells if cell.cell_type == "raw"]
    assert raw[0].startswith("# ASSIGNMENT CONFIG\n")
    opened: list[str] = []
    for source in raw[1:]:
        found = re.match(
            r"# (BEGIN|END) (QUESTION|SOLUTION|TESTS)(?:\nname: (\w+)\n(?:manual: true\n)?points: \d)?", source
        )
        assert found is not None, source
        if found[1] == "BEGIN":
            opened.append(found[2])
            assert (found[3] is not None) == (found[2] == "QUESTION")
        else:
            assert opened.pop() == found[2]
    assert opened == []
    tests = [cell.source for cell in notebook.cells if cell.source.startswith('""" # BEGIN TEST CONFIG')]
    assert (
        len(tests)
        == sum(len(question.checks) for question in questions(COURSE.points, COURSE.stages, worked_problem())) + 7
    )
    for source in tests:
        (body,) = ast.parse(source.partition('""" # END TEST CONFIG\n')[2]).body
        assert isinstance(body, ast.FunctionDef)


@pytest.mark.parametrize("system", ["nbgrader", "otter"])
def test_nothing_is_overwritten(run: Run, tmp_path: Path, system: str) -> None:
    """A second export into the same folder is refused."""
    assert run("export", system, "-o", tmp_path / "out")[0] == 0
    code, _, err = run("export", system, "-o", tmp_path / "out")
    assert code == 2
    assert "is there already and was not changed" in err


def test_feedback_goes_into_nbgraders_tree(run: Run, graded: Callable[..., Path], tmp_path: Path) -> None:
    """Each page lies in its own student's folder and names no other."""
    out = graded([result("ann"), result("x", student_id="bob")])
    assert run("export", "nbgrader", "--feedback-of", out, "-o", tmp_path / "course")[0] == 0
    pages = {path.relative_to(tmp_path / "course").as_posix(): path for path in (tmp_path / "course").rglob("*.html")}
    assert sorted(pages) == ["feedback/ann/slam1d/slam1d.html", "feedback/bob/slam1d/slam1d.html"]
    assert "bob" not in pages["feedback/ann/slam1d/slam1d.html"].read_text(encoding="utf-8")
    code, _, err = run("export", "nbgrader", "--assignment", "a+b", "-o", tmp_path / "other")
    assert code == 2
    assert "takes no name with + or /" in err


def test_a_student_has_one_place() -> None:
    """Two results of one student, or an id that is no folder, are refused."""
    with pytest.raises(UsageError, match="has two results"):
        feedback_tree([result("a", student_id="s"), result("b", student_id="s")], {"a": b"", "b": b""}, "slam1d")
    with pytest.raises(UsageError, match="cannot name a folder"):
        feedback_tree([result("a", student_id="../s")], {"a": b""}, "slam1d")
