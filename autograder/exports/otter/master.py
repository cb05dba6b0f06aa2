"""The master notebook in Otter's raw-cell format, with tests that raise (OK_FORMAT = False)."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterator, Mapping, Sequence

import nbformat
from nbformat import NotebookNode

from autograder.exports.notebooks.questions import Check, Question, answer_code, questions, solutions
from autograder.problems.problem import Problem
from autograder.render.handout import PROVIDED, provided, render_assignment
from autograder.stages import written

CONFIG = """\
# ASSIGNMENT CONFIG
name: slam1d
requirements: requirements.txt
files:
{files}
check_all_cell: false
export_cell:
  pdf: false
tests:
  ok_format: false
generate:
  show_stdout: false
  show_hidden: false
"""
README = """\
# {course} with Otter

1. `otter assign slam1d.ipynb dist` writes `dist/student/slam1d.ipynb` and `dist/autograder/*-autograder_*.zip`.
2. `otter run -a ZIP NOTEBOOK` marks one notebook, `otter grade` a folder of them in containers.

Otter runs the hidden tests in the process that runs the student's code. A student who wants to can read them there, or
make them pass without solving anything. They hold the hand-picked cases only, and give no follow-through points.
Where marks count, grade the collected notebooks with `autograder grade`: it keeps the answers in another process.
"""
MODEL = "See the model answer and the marking guide in SOLUTION.md of the grader's reference_solution."


def master_files(
    points: Mapping[str, float], stages: Sequence[str], problem: Problem, *, course: str
) -> dict[str, bytes]:
    """Lay out the folder of the master notebook.

    Parameters
    ----------
    points : mapping
        Points of every stage, as the course file has them.
    stages : sequence of str
        The stages in use.
    problem : Problem
        The problem of the notebook.
    course : str
        Title of the homework.
    """
    return {
        "slam1d.ipynb": master_notebook(points, stages, problem).encode(),
        "README.md": README.format(course=course).encode(),
        "requirements.txt": b"numpy>=2.2\n",
        **{name: provided(name).encode() for name in PROVIDED},
    }


def master_notebook(points: Mapping[str, float], stages: Sequence[str], problem: Problem) -> str:
    """Write the master notebook: that of the students, with solutions, tests and Otter's raw cells."""
    notebook: NotebookNode = nbformat.reads(render_assignment(problem)["slam1d.ipynb"], as_version=4)  # type: ignore[no-untyped-call]  # nbformat has no types
    asked: dict[str, list[Question]] = {}
    for question in questions(points, stages, problem):
        asked.setdefault(question.cell, []).append(question)
    solved = _solutions(problem)
    manual = written.QUESTIONS if written.NAME in stages else {}
    share = points.get(written.NAME, 0.0) / sum(written.QUESTIONS.values())
    found = [_raw("config", CONFIG.format(files="\n".join(f"- {name}" for name in PROVIDED)))]
    for cell in notebook.cells:
        number = cell.id.removeprefix("answer-")
        if cell.id in asked:
            cell.source = solved[cell.id]
            found += _question(cell, asked[cell.id])
        elif cell.id.startswith("answer-") and number in manual:
            found += _manual(cell, number, round(manual[number] * share, 6))
        else:
            found.append(cell)
    notebook.cells = found
    nbformat.validate(notebook)
    text: str = nbformat.writes(notebook, version=4)  # type: ignore[no-untyped-call]  # nbformat has no types
    return text + "\n"


def _question(cell: NotebookNode, several: Sequence[Question]) -> Iterator[NotebookNode]:
    """Surround a cell by the question that it answers; a second one about the same cell has tests only."""
    for place, question in enumerate(several):
        name = (question.cell if question.stage == "answers" else question.stage).replace("-", "_")
        yield _raw(f"{name}-begin", f"# BEGIN QUESTION\nname: {name}\npoints: {question.points:g}")
        if place == 0:
            yield _raw(f"{name}-solution", "# BEGIN SOLUTION")
            yield cell
            yield _raw(f"{name}-solved", "# END SOLUTION")
        yield _raw(f"{name}-tests", "# BEGIN TESTS")
        if name != "conclusion":  # no property can tell a letter without giving it away
            yield _property_test(name)
        for check in question.checks:
            yield _hidden_test(check, "iterates" if name == "iterates" else _asks(question, name))
        yield _raw(f"{name}-tested", "# END TESTS")
        yield _raw(f"{name}-end", "# END QUESTION")


def _asks(question: Question, name: str) -> str:
    """Return the name that a test needs of the student's notebook."""
    return name if question.stage == "answers" else question.cell.removeprefix("stub-").replace("-", "_")


def _manual(cell: NotebookNode, number: str, points: float) -> Iterator[NotebookNode]:
    name = f"written_{number}"
    yield _raw(f"{name}-begin", f"# BEGIN QUESTION\nname: {name}\nmanual: true\npoints: {points:g}")
    yield cell
    yield _raw(f"{name}-solution", "# BEGIN SOLUTION")
    model: NotebookNode = nbformat.v4.new_markdown_cell(MODEL, id=f"{name}-model")  # type: ignore[no-untyped-call]  # nbformat has no types
    yield model
    yield _raw(f"{name}-solved", "# END SOLUTION")
    yield _raw(f"{name}-end", "# END QUESTION")


def _property_test(name: str) -> NotebookNode:
    body = (
        "from self_check import failures\n\n"
        f'for line, wrong in failures("{name}", env):\n'
        '    assert not wrong, f"{line} {wrong}"'
    )
    return _test(f"{name}_properties", "env", body, "hidden: false\npoints: 0")


def _hidden_test(check: Check, needs: str) -> NotebookNode:
    said = f"hidden: true\npoints: {check.points:g}\nfailure_message: {_quoted(check.line)}"
    return _test(check.identifier, needs, check.code, said)


def _test(identifier: str, needs: str, body: str, config: str) -> NotebookNode:
    name = "test_" + re.sub(r"\W", "_", identifier)
    source = (
        f'""" # BEGIN TEST CONFIG\n{config}\n""" # END TEST CONFIG\n'
        f"def {name}({needs}):\n{textwrap.indent(body, '    ')}"
    )
    cell: NotebookNode = nbformat.v4.new_code_cell(source, id=_short(name))  # type: ignore[no-untyped-call]  # nbformat has no types
    return cell


def _solutions(problem: Problem) -> dict[str, str]:
    """Return for each cell that a student fills in its text with the solution and the prompt marked."""
    found = {}
    for name, (head, body) in solutions().items():
        prompt = f'    raise NotImplementedError("{name} is not finished yet: replace this line by your code.")'
        found[f"stub-{name.replace('_', '-')}"] = _marked(head + "\n", body, prompt, "    ")
    for name, code in answer_code(problem).items():
        found[name] = _marked("", code, f"{name} = None", "")
    return found


def _marked(head: str, solution: str, prompt: str, indent: str) -> str:
    return (
        f"{head}{indent}# BEGIN SOLUTION NO PROMPT\n{solution}\n{indent}# END SOLUTION\n"
        f'{indent}""" # BEGIN PROMPT\n{prompt}\n{indent}""" # END PROMPT'
    )


def _quoted(text: str) -> str:
    return "'" + text.replace("'", "''") + "'"


def _raw(name: str, source: str) -> NotebookNode:
    cell: NotebookNode = nbformat.v4.new_raw_cell(source, id=_short(f"otter-{name}"))  # type: ignore[no-untyped-call]  # nbformat has no types
    return cell


def _short(identifier: str) -> str:
    return re.sub(r"[^a-zA-Z0-9_-]", "-", identifier)[:64]
