"""How each peer is set up, and the one command with which it grades a folder of submissions."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import venv
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from autograder.course import Course
from tests.benchmarks.peers import FUNCTIONS

HERE = Path(__file__).parent
ROOT = HERE.parents[2]
BESIDE = {"exam.py": HERE / "exam.py", "posegraph.py": ROOT / "assignment/posegraph.py"}
REFERENCE = ROOT / "reference_solution/slam1d.py"
REQUIREMENTS = {
    "nbgrader": ("nbgrader", "numpy", "ipykernel"),
    "otter-grader": ("otter-grader", "numpy", "ipykernel"),
    "gradescope-utils": ("gradescope-utils", "numpy"),
}


@dataclass(frozen=True)
class Job:
    """What a peer was made ready for: commands to run one after another in a folder, with its environment active."""

    commands: list[list[str]]
    folder: Path
    environ: Mapping[str, str]


def activated(python: Path) -> dict[str, str]:
    """Return the variables of a shell in which the environment of a Python is active."""
    return {**os.environ, "PATH": f"{python.parent}{os.pathsep}{os.environ['PATH']}"}


def environment(system: str, folder: Path) -> Path:
    """Make the environment of a peer where it is missing; return its Python."""
    place = folder / system
    if not (place / "bin/python").exists():
        venv.create(place, with_pip=True)
        subprocess.run([place / "bin/python", "-m", "pip", "install", "-q", *REQUIREMENTS[system]], check=True)
    return place / "bin/python"


def version(python: Path, system: str) -> str:
    """Return the version of an installed peer."""
    words = [str(python), "-c", f"from importlib.metadata import version; print(version({system!r}))"]
    return subprocess.run(words, check=True, capture_output=True, text=True).stdout.strip()


def furnish(folder: Path) -> None:
    """Put the tests, the problem model and the reference into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, path in BESIDE.items():
        shutil.copy(path, folder / name)
    shutil.copy(REFERENCE, folder / "reference.py")


def ours(_: Path, texts: Mapping[str, str], folder: Path) -> Job:
    """Make ready our own: six stages, 200 cases each, confinement, diagnosis."""
    (folder / "uploads").mkdir(parents=True)
    for name, text in texts.items():
        (folder / f"uploads/{name}.py").write_text(text)
    stages = [
        name for name in Course().stages if name not in {"answers", "written", "sparsity_pattern", "range_factor"}
    ]
    (folder / "course.toml").write_text(f"[grading]\nstages = {json.dumps(stages)}\n")
    words = ["-m", "autograder", "grade", "uploads", "-o", "out", "--course", "course.toml", "--workers", "1", "--json"]
    return Job([[sys.executable, *words]], folder, {**os.environ, "PYTHONPATH": str(ROOT)})


def gradescope(python: Path, texts: Mapping[str, str], folder: Path) -> Job:
    """A unittest per process, weighted by gradescope-utils, as a Gradescope image runs it."""
    tests = "\n".join(
        f"    @weight(1)\n    def test_{name}(self):\n        exam.check({name!r}, slam1d.{name})\n"
        for name in FUNCTIONS
    )
    runner = (
        "import unittest\nimport exam\nimport slam1d\n"
        "from gradescope_utils.autograder_utils.decorators import weight\n"
        "from gradescope_utils.autograder_utils.json_test_runner import JSONTestRunner\n\n"
        f"class Tests(unittest.TestCase):\n{tests}\n"
        "with open('results.json', 'w') as file:\n"
        "    JSONTestRunner(stream=file).run(unittest.defaultTestLoader.loadTestsFromTestCase(Tests))\n"
    )
    commands = []
    for name, text in texts.items():
        furnish(folder / name)
        (folder / name / "slam1d.py").write_text(text)
        (folder / name / "run_tests.py").write_text(runner)
        commands.append(["sh", "-c", f"cd {name} && {python} run_tests.py"])
    return Job(commands, folder, activated(python))


def otter(python: Path, texts: Mapping[str, str], folder: Path) -> Job:
    """`otter run` a submission, with tests that raise."""
    furnish(folder)
    (folder / "tests").mkdir()
    for name in FUNCTIONS:
        (folder / f"tests/{name}.py").write_text(
            "from otter.test_files import test_case\n\nOK_FORMAT = False\n"
            f"name = {name!r}\npoints = 1\n\n@test_case()\ndef test_{name}({name}):\n"
            f"    import exam\n    exam.check({name!r}, {name})\n"
        )
    binary = python.with_name("otter")
    generate = [
        str(binary),
        "generate",
        "-t",
        "tests",
        "-o",
        "autograder.zip",
        "exam.py",
        "posegraph.py",
        "reference.py",
    ]
    subprocess.run(generate, check=True, capture_output=True, cwd=folder, env=activated(python))
    commands = []
    for name, text in texts.items():
        (folder / name).mkdir()
        # A notebook: beside a .py submission Otter accepts no other Python file, and the tests need some.
        cell = {**_cell("work", text, solution=True), "metadata": {}}
        (folder / f"{name}/slam1d.ipynb").write_text(_notebook([cell]))
        commands.append([str(binary), "run", "-a", "autograder.zip", "-o", name, f"{name}/slam1d.ipynb"])
    return Job(commands, folder, activated(python))


def nbgrader(python: Path, texts: Mapping[str, str], folder: Path) -> Job:
    """`nbgrader autograde` over a course of notebooks, with the hidden tests in its cells, and its feedback."""
    for place in ("source/ps", *(f"submitted/{name}/ps" for name in texts)):
        furnish(folder / place)
    cells = [_cell("solution", "", solution=True)]
    cells += [_cell(name, f"import exam\nexam.check({name!r}, {name})", points=1) for name in FUNCTIONS]
    (folder / "source/ps/slam1d.ipynb").write_text(_notebook(cells))
    (folder / "nbgrader_config.py").write_text(
        "c = get_config()\nc.CourseDirectory.course_id = 'slam'\n"
        "c.ClearSolutions.enforce_metadata = False\nc.ExecutePreprocessor.timeout = 20\n"
    )
    binary = str(python.with_name("nbgrader"))
    subprocess.run(
        [binary, "generate_assignment", "ps"], check=True, capture_output=True, cwd=folder, env=activated(python)
    )
    for name, text in texts.items():
        filled = [{**cells[0], "source": text}, *cells[1:]]
        (folder / f"submitted/{name}/ps/slam1d.ipynb").write_text(_notebook(filled))
    return Job([[binary, "autograde", "ps"], [binary, "generate_feedback", "ps"]], folder, activated(python))


def _cell(name: str, source: str, *, solution: bool = False, points: int = 0) -> dict[str, object]:
    mark = {"grade": not solution, "solution": solution, "locked": not solution, "schema_version": 3}
    mark |= {"grade_id": name, "task": False} | ({} if solution else {"points": points})
    return {
        "cell_type": "code",
        "id": re.sub("_", "-", name),
        "execution_count": None,
        "metadata": {"nbgrader": mark},
        "outputs": [],
        "source": source,
    }


def _notebook(cells: list[dict[str, object]]) -> str:
    kernel = {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"}}
    return json.dumps({"cells": cells, "metadata": kernel, "nbformat": 4, "nbformat_minor": 5})
