"""The questions of the homework for other graders: points as in the course file, hidden tests from the fixed core.

A check of ours becomes a test there. It sees the hand-picked cases only, which show every known mistake; the cases
drawn from the seed stay here.
"""

from __future__ import annotations

import ast
import base64
import inspect
import json
import textwrap
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from assignment.posegraph import PoseGraph
from autograder.exports.notebooks import judging
from autograder.problems.cases import Case
from autograder.problems.conclusion import RIGHT, choices
from autograder.problems.problem import Problem
from autograder.render.facts import reference, solve
from autograder.render.stub import reference_source, stubs
from autograder.stages import answers, gauss_newton_step, second_step
from autograder.stages.base import ArrayStage, Stage
from autograder.stages.catalogue import all_stages

_GRAPH = ("n_poses", "edges", "measurements", "edge_variances", "priors", "prior_means", "prior_variances")
_MAY_ASK = ("residual", "jacobian", "information_matrix", "normal_equations", "gauss_newton_step", "second_step")


@dataclass(frozen=True)
class Check:
    """One test: its identifier, what it asks, its points, and the code that asks it."""

    identifier: str
    line: str
    points: float
    code: str


@dataclass(frozen=True)
class Question:
    """One stage: which cell of the notebook it is about, and its tests."""

    stage: str
    cell: str
    checks: tuple[Check, ...]

    @property
    def points(self) -> float:
        """The points of the stage."""
        return round(sum(check.points for check in self.checks), 6)


def questions(points: Mapping[str, float], stages: Sequence[str], problem: Problem) -> tuple[Question, ...]:
    """List the questions that a course uses, in the order of the notebook; bonus stages stay in explore.ipynb."""
    found = [
        _question(stage, points[stage.name])
        for stage in all_stages()
        if stage.name in stages and stage.name in _MAY_ASK
    ]
    if answers.NAME in stages:
        found += _answers(problem, points[answers.NAME])
    return tuple(found)


def solutions() -> dict[str, tuple[str, str]]:
    """Return for each function of the reference its stub without the last line, and its body, indented."""
    source = reference_source()
    lines = source.splitlines()
    found = {}
    for node in ast.parse(source).body:
        if isinstance(node, ast.FunctionDef) and node.name[0] != "_":
            head = stubs(source)[node.name].rpartition("\n")[0]
            first, last = node.body[1].lineno, node.end_lineno
            found[node.name] = (head, "\n".join(lines[first - 1 : last]))
    return found


def answer_code(problem: Problem) -> dict[str, str]:
    """Return the code that answers questions 2 and 3: name of the answer -> code."""
    return {
        "iterates": "rows = [my_start]\nfor _ in range(3):\n"
        "    rows.append(rows[-1] + gauss_newton_step(rows[-1], my_graph))\niterates = np.array(rows)",
        "conclusion": f"conclusion = {right_letter(problem)!r}",
    }


def right_letter(problem: Problem) -> str:
    """Return the letter of the right conclusion."""
    return next(one.letter for one in choices(problem.variant) if one.identifier == RIGHT)


def _question(stage: Stage, points: float) -> Question:
    checks = []
    for rung in stage.ladder.rungs:
        kind, cases = _packed_cases(stage, rung.core)
        line = f"{stage.title}: {rung.line}"
        code = _code(kind, stage.function, cases, line)
        worth = round(points * stage.shares[rung.name], 6)
        checks.append(Check(f"{stage.name}-{rung.name}", line, worth, code))
    return Question(stage.name, f"stub-{stage.function.replace('_', '-')}", tuple(checks))


def _packed_cases(stage: Stage, core: Sequence[Case]) -> tuple[str, list[dict[str, Any]]]:
    """Turn cases into what the judging code reads, with the name of that code."""
    if isinstance(stage, second_step.SecondStep):
        return "judge_second_step", [
            {"calls": _plain(stage.calls(case)), "tolerance": second_step.tolerance(*case)} for case in core
        ]
    if isinstance(stage, gauss_newton_step.GaussNewtonStep):
        cases, right = [], reference()
        for case in core:
            x, graph = case
            J, omega, f = right.jacobian(x, graph), right.information_matrix(graph), right.residual(x, graph)
            H, b = right.normal_equations(J, omega, f)
            cases.append(
                {
                    "calls": _plain([case]),
                    "expected": [H.tolist(), b.tolist()],
                    "scale": float(stage.prepare([case]).b_scale[0]),
                    "tolerance": gauss_newton_step.BACKWARD_ERROR,
                }
            )
        return "judge_step", cases
    assert isinstance(stage, ArrayStage), stage.name
    return "judge_arrays", [
        {
            "calls": _plain([call]),
            "expected": [array.tolist() for array in stage.expected(*call)],
            "tolerance": [np.asarray(array).tolist() for array in stage.tolerance(*call)],
        }
        for case in core
        for call in stage.calls(case)
    ]


def _plain(calls: Sequence[Case]) -> list[list[Any]]:
    return [[_argument(argument) for argument in call] for call in calls]


def _argument(argument: Any) -> Any:
    if not isinstance(argument, PoseGraph):
        return np.asarray(argument).tolist()
    return {name: np.asarray(getattr(argument, name)).tolist() for name in _GRAPH}


def _code(kind: str, function: str, cases: list[dict[str, Any]], line: str) -> str:
    """Write the code of one test: the judging functions that it needs, the cases, and the call."""
    needed = [inspect.getsource(judging.unpack), inspect.getsource(judging.answer)]
    needed.append(inspect.getsource(getattr(judging, kind)))
    data = base64.b64encode(zlib.compress(json.dumps(cases, separators=(",", ":")).encode(), 9)).decode()
    return "\n".join(
        [
            "from collections.abc import Callable",
            "from typing import Any",
            "",
            "from posegraph import PoseGraph",
            "",
            *(_without_silencers(text) for text in needed),
            f'DATA = """\n{textwrap.fill(data, 110)}\n"""',
            f"{kind}({function}, unpack(DATA, PoseGraph), {line!r})",
        ]
    )


def _without_silencers(text: str) -> str:
    return "\n".join(line.split("  # noqa")[0] for line in text.splitlines()) + "\n"


def _answers(problem: Problem, points: float) -> list[Question]:
    """Ask for the iterates and the conclusion of the problem of the notebook."""
    wanted = solve(problem).iterates
    close = answers.CLOSE * (1.0 + float(np.abs(wanted).max()))
    iterates = f"""\
import numpy as np

EXPECTED = np.array({wanted.round(12).tolist()})
assert iterates is not None, "iterates is still None"
GOT = np.array(iterates, dtype=float)
assert GOT.shape == EXPECTED.shape, f"iterates has shape {{GOT.shape}}, expected {{EXPECTED.shape}}"
assert (np.abs(GOT - EXPECTED) <= {close!r}).all(), "iterates do not belong to this graph"
"""
    conclusion = f"""\
assert conclusion is not None, "conclusion is still None"
assert str(conclusion).strip().strip("().").upper() == {right_letter(problem)!r}, "this choice is not the reason"
"""
    asked = {
        "iterates": ("Question 2: the four iterates of your graph", iterates),
        "conclusion": ("Question 3: the choice that explains it", conclusion),
    }
    return [
        Question(
            answers.NAME,
            name,
            (Check(f"{answers.NAME}-{name}", line, round(points * answers.SHARES[name], 6), code.rstrip()),),
        )
        for name, (line, code) in asked.items()
    ]
