"""The notebooks as they are read: order, equations, questions, widths, and a Python of years ago."""

import ast
import re
from pathlib import Path

import nbformat
import pytest

from autograder.problems.problem import worked_problem
from autograder.render.handout import render_assignment
from autograder.render.stub import CORE
from tests.render.another import another_problem

ROOT = Path(__file__).parents[2]
NAMES = ("slam1d.ipynb", "explore.ipynb")
NOTEBOOKS = {name: nbformat.reads(render_assignment(worked_problem())[name], as_version=4) for name in NAMES}
WIDEST = 104  # characters of a line, as in the self-check: a laptop shows no more


def cells_of(name):
    """Cells of a notebook, by id and in order."""
    return {cell.id: cell for cell in NOTEBOOKS[name].cells}


def test_every_part_has_its_equation_its_question_its_stub_and_its_check():
    """Each function comes after words with an equation and a question to think about; its check follows at once."""
    order = list(cells_of("slam1d.ipynb"))
    assert [name for name in order if name.startswith("stub-")] == [f"stub-{name.replace('_', '-')}" for name in CORE]
    for name in CORE:
        stub = order.index(f"stub-{name.replace('_', '-')}")
        words = cells_of("slam1d.ipynb")[order[stub - 1]]
        assert words.cell_type == "markdown"
        assert "$$" in words.source
        assert "**Think first.**" in words.source or "**Predict.**" in words.source
        assert "?" in words.source.partition("first.")[2] + words.source.partition("Predict.")[2]
        assert order[stub + 1] == order[stub].replace("stub", "check")


def test_the_story_comes_before_the_first_stub():
    """Objectives, prerequisites and minutes stand at the top; then the graph in words, symbols and model."""
    order = list(cells_of("slam1d.ipynb"))
    for words in ("**Afterwards you can**", "**You need**", "| minutes |"):
        assert words in cells_of("slam1d.ipynb")["title"].source
    assert order[0] == "title"
    places = [order.index(name) for name in ("my-problem", "walk", "symbols", "model", "part-1", "stub-residual")]
    assert places == sorted(places)


def test_no_cell_before_question_3_answers_it():
    """What the choices claim is asked before, never told; the last cell does not name what would break it."""
    cells = cells_of("slam1d.ipynb")
    told = "\n".join(cell.source for cell in cells.values() if cell.cell_type == "markdown")
    assert not re.search(r"(?i)not linear|nonlinear|no estimate can|does not reach|shared out|dispute vanish;", told)
    assert "has the estimate reached the truth? Has the dispute vanished?" in cells["gained"].source


def test_the_notebook_ends_with_question_3():
    """After the last question come its answers, the whole check and how to hand in; nothing else."""
    order = list(cells_of("slam1d.ipynb"))
    assert order[order.index("question-3") :] == ["question-3", "conclusion", "answer-3", "check-all", "hand-in"]
    assert "explore.ipynb" in cells_of("slam1d.ipynb")["hand-in"].source


@pytest.mark.parametrize("name", NAMES)
def test_no_line_of_code_is_cut_off(name):
    """Code that is not folded away fits into the window of a laptop."""
    shown = [cell for cell in NOTEBOOKS[name].cells if cell.cell_type == "code" and "tags" not in cell.metadata]
    assert [line for cell in shown for line in cell.source.splitlines() if len(line) > WIDEST] == []


@pytest.mark.parametrize("name", NAMES)
def test_folded_cells_say_what_they_are(name):
    """A cell that hides its code begins with a title, which Colab shows in its place."""
    folded = [cell for cell in NOTEBOOKS[name].cells if "tags" in cell.metadata]
    assert len(folded) >= 3
    assert all(cell.source.startswith("# @title Provided: ") for cell in folded)


def test_the_provided_code_can_be_left_out_of_a_page():
    """The tag that staff are told to remove is the one of all folded cells, and of no other."""
    told = re.search(r"remove_input_tags=(\S+) ", (ROOT / "docs" / "instructor.md").read_text(encoding="utf-8"))
    assert told is not None
    for name in NAMES:
        tagged = {cell.id for cell in NOTEBOOKS[name].cells if told[1] in cell.metadata.get("tags", [])}
        folded = {c.id for c in NOTEBOOKS[name].cells if c.metadata.get("jupyter", {}).get("source_hidden")}
        assert tagged == folded != set()


@pytest.mark.parametrize("name", NAMES)
def test_an_older_python_can_read_every_cell(name):
    """Every cell parses as Python 3.9, and annotations, which run there, have no bar between types."""
    for cell in NOTEBOOKS[name].cells:
        if cell.cell_type == "code":
            tree = ast.parse(cell.source, feature_version=(3, 9))
            notes = [node.annotation for node in ast.walk(tree) if isinstance(node, (ast.arg, ast.AnnAssign))]
            notes += [node.returns for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)]
            assert not [note for note in notes if note is not None and "|" in ast.unparse(note)]


def test_the_students_own_numbers_are_used_throughout():
    """Another problem changes the graph, the start, the truth and the rows by hand; no cell keeps the old ones."""
    other = nbformat.reads(render_assignment(another_problem())["slam1d.ipynb"], as_version=4)
    mine = {cell.id: cell.source for cell in other.cells}
    theirs = {name: cell.source for name, cell in cells_of("slam1d.ipynb").items()}
    changed = {name for name in mine if mine[name] != theirs[name]}
    assert {"title", "my-problem", "part-1", "part-3", "question-3"} <= changed
    assert "0.8" in mine["part-1"]
    assert "2.5" in mine["part-1"]
    assert not [name for name, text in mine.items() if "-2.7" in text and not name.startswith("provided")]
