"""The files of a student run on Python 3.9 with numpy 1.22, and on Windows."""

import ast
import json
import os
import re
import subprocess
from pathlib import Path

import pytest

from autograder.problems.problem import worked_problem
from autograder.render.handout import render_folder, write_files
from autograder.render.stub import reference_source
from tests.assignment.running import reference_functions

ROOT = Path(__file__).parents[2]
PROVIDED = ("posegraph.py", "self_check.py")
OLD = os.environ.get("OLD_PYTHON", "")  # an interpreter of Python 3.9 with numpy 1.22

# Everything of numpy that the provided files use. Before a name is added, look it up in numpy 1.22.
NUMPY = (
    "abs allclose append arange argmax argwhere array array_equal asarray diag empty eye flatnonzero float64 "
    "frombuffer full hypot int64 integer isfinite isnan linspace ma nan ndarray ndim ones sqrt where zeros"
)

STANDARD = "__future__ collections.abc contextlib dataclasses pathlib sys textwrap threading traceback types typing"


def test_the_oldest_python_is_the_one_that_is_told():
    """The handout names the version that is tried here."""
    told = re.search(r"Python \((\S+) or newer\)", render_folder(worked_problem())["README.md"])
    assert told is not None
    assert f"(3, {told[1].partition('.')[2]})" == "(3, 9)"


@pytest.mark.parametrize("name", PROVIDED)
def test_nothing_of_numpy_is_newer_than_1_22(name):
    """Every attribute of np is in the list of old ones."""
    tree = ast.parse((ROOT / "assignment" / name).read_text(encoding="utf-8"), feature_version=(3, 9))
    used = {
        node.attr
        for node in ast.walk(tree)
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "np"
    }
    assert len(used) > 3
    assert used - set(NUMPY.split()) == set()


@pytest.mark.parametrize("name", PROVIDED)
def test_windows_reads_and_prints_it(name):
    """Plain ASCII, texts opened as UTF-8, no path written with slashes and nothing that only Unix has."""
    text = (ROOT / "assignment" / name).read_text(encoding="utf-8")
    assert text.isascii()
    assert text.count(".read_text(") == text.count(".read_text(encoding=")
    assert "open(" not in text
    imported = {node.module for node in ast.walk(ast.parse(text)) if isinstance(node, ast.ImportFrom)}
    imported |= {n.name for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Import) for n in node.names}
    assert imported <= {*STANDARD.split(), "numpy", "posegraph"}


def old(folder, *arguments):
    """Run the old Python in a folder, warnings being errors; return what it printed."""
    command = [OLD, "-W", "error", *arguments]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False, timeout=120)
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout


@pytest.mark.skipif(not OLD, reason="OLD_PYTHON names no interpreter of Python 3.9 with numpy 1.22")
@pytest.mark.slow
@pytest.mark.parametrize("work", ["stub", "reference"])
def test_the_self_check_runs_on_the_oldest_python(work, tmp_path):
    """In a released folder: the stub is open work, the reference passes; no warning is printed."""
    version = old(tmp_path, "-c", "import sys, numpy; print(sys.version_info[:2], numpy.__version__)")
    assert version.startswith("(3, 9) 1.22.")
    write_files(render_folder(worked_problem()), tmp_path)
    if work == "reference":
        (tmp_path / "slam1d.py").write_text(reference_source(), encoding="utf-8")
    first, _, printed = old(tmp_path, "self_check.py").partition("\n")
    assert first.startswith("Checking slam1d.py")
    kinds = {line[:4] for line in printed.splitlines() if not line.startswith(" ")}
    assert kinds == ({"PASS", "TODO", "What"} if work == "reference" else {"TODO", "What"})


@pytest.mark.skipif(not OLD, reason="OLD_PYTHON names no interpreter of Python 3.9 with numpy 1.22")
@pytest.mark.slow
def test_the_notebook_runs_on_the_oldest_python(tmp_path):
    """Its cells with the reference pasted in, alone in an empty folder; pictures are drawn and not shown."""
    cells = json.loads(render_folder(worked_problem())["slam1d.ipynb"])["cells"]
    functions = reference_functions()
    sources = [
        functions.get(cell["id"].removeprefix("stub-").replace("-", "_"), "".join(cell["source"]))
        for cell in cells
        if cell["cell_type"] == "code" and cell["id"] != "check-iterates"
    ]
    fake = "import sys, types\nshown = types.ModuleType('IPython.display')\nshown.display = lambda *a, **k: None\n"
    fake += "sys.modules['IPython'] = types.ModuleType('IPython')\nsys.modules['IPython'].display = shown\n"
    fake += "sys.modules['IPython.display'] = shown\n"
    (tmp_path / "cells.py").write_text(fake + "\n\n".join(sources), encoding="utf-8")
    printed = old(tmp_path, "cells.py")
    assert "RMSE: 0.249 m -> 0.077 m" in printed
    assert "FAIL" not in printed
