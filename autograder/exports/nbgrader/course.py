"""A course folder for nbgrader: the source notebook, what students need beside it, and the settings."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import nbformat
from nbformat import NotebookNode

from autograder.exports.nbgrader import cells
from autograder.exports.notebooks.questions import Question, answer_code, questions, solutions
from autograder.problems.problem import Problem
from autograder.render.handout import PROVIDED, provided, render_assignment
from autograder.stages import written

CONFIG = """\
# Settings of this course: nbgrader reads them where it is started, in this folder.
c = get_config()
c.CourseDirectory.course_id = {course!r}
"""
MODEL = "See the model answer and the marking guide in SOLUTION.md of the grader's reference_solution."
README = """\
# {course} with nbgrader

1. `nbgrader generate_assignment {assignment}` writes the notebook for students to `release/{assignment}`.
2. Collected notebooks go to `submitted/STUDENT/{assignment}/slam1d.ipynb`.
3. `nbgrader autograde {assignment}` marks them; `nbgrader formgrader` shows the written answers to mark by hand.

nbgrader runs the hidden tests in the process that runs the student's code. A student who wants to can read them there,
or make them pass without solving anything. They hold the hand-picked cases only, and give no follow-through points.
Where marks count, grade the same folder with `autograder grade submitted/ -o graded`: it reads this layout.
"""


def course_files(
    points: Mapping[str, float], stages: Sequence[str], problem: Problem, *, assignment: str, course: str
) -> dict[str, bytes]:
    """Lay out the course folder.

    Parameters
    ----------
    points : mapping
        Points of every stage, as the course file has them.
    stages : sequence of str
        The stages in use.
    problem : Problem
        The problem of the notebook.
    assignment : str
        Name of the assignment's folder.
    course : str
        Title of the homework.
    """
    below = f"source/{assignment}"
    return {
        "nbgrader_config.py": CONFIG.format(course=course).encode(),
        "README.md": README.format(course=course, assignment=assignment).encode(),
        f"{below}/slam1d.ipynb": source_notebook(points, stages, problem).encode(),
        **{f"{below}/{name}": provided(name).encode() for name in PROVIDED},
    }


def source_notebook(points: Mapping[str, float], stages: Sequence[str], problem: Problem) -> str:
    """Write the source notebook: that of the students, with solutions, tests and metadata."""
    notebook: NotebookNode = nbformat.reads(render_assignment(problem)["slam1d.ipynb"], as_version=4)  # type: ignore[no-untyped-call]  # nbformat has no types
    asked: dict[str, list[Question]] = {}
    for question in questions(points, stages, problem):
        asked.setdefault(question.cell, []).append(question)
    solved = _solutions(problem)
    manual = _manual(points, stages)
    found: list[NotebookNode] = [cells.test("for-staff", cells.FOR_STAFF, 0.0)]
    for cell in notebook.cells:
        found.append(cell)
        if cell.id in solved:
            cells.solution(cell, cell.id.removeprefix("stub-"), solved[cell.id])
        elif cell.id in manual:
            source = f"{cell.source}\n\n{cells.BEGIN}\n{MODEL}\n{cells.END}"
            cells.manual(cell, f"written-{cell.id}", source, manual[cell.id])
        for question in asked.get(cell.id, ()):
            if question.cell != "conclusion":  # no property can tell a letter without giving it away
                found.append(cells.property_test(question))
            found += [cells.hidden_test(check) for check in question.checks]
    notebook.cells = [found[1], found[0], *found[2:]]  # the title stands first
    nbformat.validate(notebook)
    text: str = nbformat.writes(notebook, version=4)  # type: ignore[no-untyped-call]  # nbformat has no types
    return text + "\n"


def _solutions(problem: Problem) -> dict[str, str]:
    """Return for each cell that a student fills in its text with the solution marked."""
    found = {
        f"stub-{name.replace('_', '-')}": f"{head}\n    {cells.BEGIN}\n{body}\n    {cells.END}"
        for name, (head, body) in solutions().items()
    }
    for name, code in answer_code(problem).items():
        found[name] = f"{name} = None\n{cells.BEGIN}\n{code}\n{cells.END}"
    return found


def _manual(points: Mapping[str, float], stages: Sequence[str]) -> dict[str, float]:
    """Return for each cell that a human marks its points."""
    if written.NAME not in stages:
        return {}
    share = points[written.NAME] / sum(written.QUESTIONS.values())
    return {f"answer-{number}": round(part * share, 6) for number, part in written.QUESTIONS.items()}
