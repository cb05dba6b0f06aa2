"""The committed assignment is what rendering gives, complete, typed, and free of answers."""

import subprocess
import sys
from pathlib import Path

import nbformat
import pytest

from autograder.problems.problem import worked_problem
from autograder.render.__main__ import main
from autograder.render.handout import render_assignment, render_folder, write_files
from autograder.render.stub import reference_source

ASSIGNMENT = Path(__file__).parents[2] / "assignment"


@pytest.mark.parametrize("name", list(render_assignment(worked_problem())))
def test_rendering_again_changes_nothing(name):
    """The committed files are current: `python -m autograder.render` would write the same bytes."""
    rendered = render_assignment(worked_problem())[name]
    assert (ASSIGNMENT / name).read_bytes() == rendered.encode()


def test_the_command_says_what_changed(tmp_path, capsys):
    """A second run writes nothing; a folder that is no checkout is refused with a sentence."""
    (tmp_path / "assignment").mkdir()
    (tmp_path / "assignment" / "posegraph.py").touch()
    assert main([str(tmp_path)]) == 0
    assert "slam1d.ipynb" in capsys.readouterr().out
    assert main([str(tmp_path)]) == 0
    assert capsys.readouterr().out == "changed: nothing\n"
    assert main([str(tmp_path / "assignment")]) == 2
    assert "expected the folder of a checkout" in capsys.readouterr().err


def test_the_notebook_is_valid_and_has_no_outputs():
    """The notebook validates against nbformat 4.5 and was never run."""
    notebook = nbformat.read(ASSIGNMENT / "slam1d.ipynb", as_version=4)
    nbformat.validate(notebook)
    assert notebook.nbformat_minor == 5
    assert all(not cell.outputs and cell.execution_count is None for cell in notebook.cells if cell.cell_type == "code")


def code_lines(source):
    """Lines of code that are no definition, no comment and long enough to be telling."""
    body = source.split('"""')[::2]
    lines = (line.strip() for part in body for line in part.splitlines())
    return {line for line in lines if len(line) > 12 and not line.startswith(("def ", "import ", "from ", "if ", "#"))}


def test_no_line_of_the_reference_is_handed_out():
    """No student-facing file holds a line of a reference body."""
    handed_out = "\n".join(render_folder(worked_problem()).values())
    lines = code_lines(reference_source())
    assert "H = J.T @ omega @ J" in lines
    assert [line for line in lines if line in handed_out] == []


@pytest.mark.slow
def test_a_released_folder_type_checks(tmp_path):
    """Beside `posegraph.py`, the stub passes mypy --strict."""
    write_files(render_folder(worked_problem()), tmp_path)
    command = [sys.executable, "-m", "mypy", "--strict", "--no-error-summary", "--cache-dir", str(tmp_path / "cache")]
    done = subprocess.run([*command, "slam1d.py"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (0, "")
