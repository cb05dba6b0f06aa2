"""A folder of uploads is the current folder: no way into the grader runs a file of it in the grader's own process."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.engine.site import Site

ROOT = Path(__file__).parent.parent
NAMES = ("csv", "socket", "pickle", "json", "msgspec", "numpy", "random", "tempfile", "logging", "click", "selectors")


@pytest.fixture
def uploads(tmp_path: Path) -> Path:
    """Write a class whose files have the names of modules that the grader imports; each leaves a mark where it runs."""
    folder = tmp_path / "class of uploads"
    folder.mkdir()
    for name in NAMES:
        mark = f"open({str(tmp_path / 'ran')!r}, 'a').write({name!r})"
        (folder / f"{name}.py").write_text(f"try:\n    {mark}\nexcept OSError:\n    pass\nraise SystemExit(77)\n")
    return folder


def _started(folder: Path, *command: str) -> None:
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONSAFEPATH"}
    done = subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, timeout=120, check=False
    )
    ran = folder.parent / "ran"
    assert not ran.exists(), ran.read_text()
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    "way",
    [
        ("-m", "autograder"),
        ("-I", "-m", "autograder"),
        ("-P", "-c", "from autograder.cli import main; main()"),
    ],
    ids=["-m", "-I -m", "console script"],
)
def test_grading_the_current_folder_runs_nothing_of_it_in_the_grader(uploads: Path, way: tuple[str, ...]) -> None:
    """Two workers are started, and the fork server of each: none of them looks into the folder either."""
    _started(uploads, sys.executable, *way, "grade", ".", "-o", "../out", "--workers", "2", "--examples", "5")
    rows = (uploads.parent / "out/grades.csv").read_text().splitlines()
    assert len(rows) == 1 + len(NAMES)


def test_the_processes_of_a_release_run_nothing_of_the_current_folder(uploads: Path) -> None:
    """They are fresh interpreters, and a fresh interpreter looks into the current folder first unless it is told."""
    (uploads / "class.csv").write_text("student_id\n" + "".join(f"s{number}\n" for number in range(20)))
    (uploads / "secret.txt").write_text("0123456789abcdef0123456789abcdef\n")
    arguments = ("release", "--roster", "class.csv", "--term", "2026S", "--secret-file", "secret.txt", "-o", "../rel")
    _started(uploads, sys.executable, "-m", "autograder", *arguments, "--workers", "2")


@pytest.mark.slow
@pytest.mark.parametrize("system", ["nbgrader", "otter", "gradescope"])
def test_what_makes_other_systems_files_runs_nothing_of_the_current_folder(uploads: Path, system: str) -> None:
    """The exports of an assignment import the libraries of that system."""
    target = "../made.zip" if system == "gradescope" else "../made"
    _started(uploads, sys.executable, "-m", "autograder", "export", system, "-o", target)
    assert (uploads.parent / target.removeprefix("../")).exists()


@pytest.mark.slow
def test_a_worker_of_a_cluster_runs_nothing_of_its_current_folder(uploads: Path, tmp_path: Path) -> None:
    """It is started as the page on clusters says, in the folder of the uploads; so is the grader that uses it."""
    pytest.importorskip("distributed", reason="the extra `cluster` is not installed")
    page = (ROOT / "docs/cluster.md").read_text("utf-8")
    (line,) = (line for line in page.splitlines() if line.startswith("PYTHONSAFEPATH=1 dask worker tcp://"))
    words = line.partition("#")[0].split()[1:]
    program = str(Path(sys.executable).parent / words[0])
    site = Site(tmp_path)
    words = [site.address if word.startswith("tcp://") else word for word in words[1:]]
    words[words.index("--nworkers") + 1] = "1"
    environment = {**os.environ, "PYTHONSAFEPATH": "1"}
    try:
        with (tmp_path / "worker.log").open("wb") as log:
            worker = subprocess.Popen(
                [program, *words, "--local-directory", str(tmp_path)],
                cwd=uploads, env=environment, stdout=log, stderr=log,
            )  # fmt: skip
        site.workers.append(worker)
        _started(
            uploads, sys.executable, "-m", "autograder", "grade", ".", "-o", "../out", "--examples", "1",
            "--scheduler", site.address,
        )  # fmt: skip
    finally:
        site.close()
    assert len((tmp_path / "out/grades.csv").read_text().splitlines()) == 1 + len(NAMES)


def test_every_python_that_is_started_leaves_the_current_folder_off_its_path() -> None:
    """The program's own ones and those of the examples say it with a switch."""
    switches = {}
    for path in (*(ROOT / "autograder").rglob("*.py"), *(ROOT / "docs/examples").glob("*.py")):
        text = path.read_text("utf-8")
        for found in re.finditer(r"sys\.executable(?!\)\.parent)", text):
            switches[path.name] = bool(re.search(r"(?<![\w-])-[IP](?!\w)", text[found.end() :][:200]))
    assert switches == {"server.py": True, "demo.py": True, "prairielearn.py": True}


def test_gradescopes_run_starts_python_isolated() -> None:
    """There the current folder is what the student uploaded, or above it."""
    script = (ROOT / "autograder/exports/gradescope/run_autograder").read_text()
    assert 'bin/python" -I -m autograder.commands._on_gradescope' in script


def test_the_package_imports_nothing_before_the_path_is_clean() -> None:
    """`autograder/__init__.py` imports only what every Python has loaded by then."""
    before, cleaned, _ = (ROOT / "autograder/__init__.py").read_text().partition("sys.path[:] = ")
    assert cleaned
    imports = [line for line in before.splitlines() if line.lstrip().startswith(("import ", "from "))]
    assert imports == ["import os", "import sys"]
