"""The wheel is whole: installed into an empty environment it does, outside the checkout, what the checkout does."""

from __future__ import annotations

import importlib.metadata
import os
import re
import shutil
import subprocess
import sys
import venv
import zipfile
from pathlib import Path

import pytest
from packaging.requirements import Requirement

ROOT = Path(__file__).resolve().parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")
PACKAGES = ("assignment", "autograder", "reference_solution")


def _run(*command: str | Path, cwd: Path, home: Path | None = None) -> subprocess.CompletedProcess[str]:
    ours = "-m" not in command  # old versions of pip warn on new versions of Python
    run = subprocess.run(
        command,
        cwd=cwd,
        env={"PATH": "/usr/bin:/bin", "HOME": str(home or cwd), "PYTHONWARNINGS": "error" if ours else "default"},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, f"{command} ended with {run.returncode}:\n{run.stdout}\n{run.stderr}"
    return run


@pytest.fixture(scope="session")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build the wheel from this checkout."""
    out = tmp_path_factory.mktemp("wheel")
    _run(sys.executable, "-m", "hatchling", "build", "--target", "wheel", "--directory", out, cwd=ROOT, home=out)
    (built,) = out.glob("*.whl")
    return built


@pytest.fixture(scope="session")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Make an empty environment and install the wheel and what it declares into it; return its bin folder.

    What it declares is taken file by file from this environment, which holds the locked versions:
    no network, and a dependency that is not declared is not there.
    """
    place = tmp_path_factory.mktemp("environment")
    venv.create(place, symlinks=True)
    (site,) = place.glob("lib/python*/site-packages")
    metadata = importlib.metadata.Distribution.at(_unpacked_metadata(wheel, tmp_path_factory.mktemp("metadata")))
    for name in _closure(metadata.requires or []):
        _copy(importlib.metadata.distribution(name), site)
    with zipfile.ZipFile(wheel) as archive:  # what an installer does, without one: not every environment holds pip
        archive.extractall(site)
    (start,) = importlib.metadata.Distribution.at(next(site.glob("slam1d_homework-*.dist-info"))).entry_points
    script = place / "bin" / start.name
    script.write_text(SCRIPT.format(module=start.module, function=start.attr), encoding="utf-8")
    script.chmod(0o755)
    return place / "bin"


# Beside its interpreter, wherever that is: a first line may hold no blank.
SCRIPT = """#!/bin/sh
'''exec' "$(dirname "$0")/python" "$0" "$@"
' '''
from {module} import {function}
if __name__ == "__main__":
    {function}()
"""


def _unpacked_metadata(wheel: Path, out: Path) -> Path:
    with zipfile.ZipFile(wheel) as archive:
        (name,) = (name for name in archive.namelist() if name.endswith(".dist-info/METADATA"))
        archive.extract(name, out)
    return (out / name).parent


def _closure(requirements: list[str]) -> set[str]:
    found: set[str] = set()
    queue = list(requirements)
    while queue:
        requirement = Requirement(queue.pop())
        wanted = requirement.marker is None or requirement.marker.evaluate({"extra": ""})
        if wanted and requirement.name not in found:
            found.add(requirement.name)
            queue += importlib.metadata.requires(requirement.name) or []
    return found


def _copy(distribution: importlib.metadata.Distribution, site: Path) -> None:
    for file in distribution.files or []:
        source = Path(str(file.locate()))
        if ".." in file.parts or source.suffix == ".pyc" or not source.exists():
            continue  # scripts in bin, and what Python compiles again
        (site / file).parent.mkdir(parents=True, exist_ok=True)
        try:
            os.link(source, site / file)
        except OSError:  # another file system
            shutil.copyfile(source, site / file)


def _files(root: Path) -> set[str]:
    paths = (path for package in PACKAGES for path in (root / package).rglob("*") if path.is_file())
    return {path.relative_to(root).as_posix() for path in paths if "__pycache__" not in path.parts}


def test_no_page_advises_a_name_that_is_not_ours() -> None:
    """The name of this distribution stands on no index: who installs it by name gets a stranger's program."""
    paths = [
        ROOT / "README.md",
        *(path for part in ("docs", ".github", *PACKAGES) for path in (ROOT / part).rglob("*")),
    ]
    texts = [path.read_text(encoding="utf-8") for path in paths if path.suffix in {".md", ".py", ".yml", ".j2", ".sh"}]
    assert len(texts) > 100
    assert not [text for text in texts if re.search(r"(pip|uv|pipx) [^\n]*\bslam1d-homework\b", text)]


@pytest.mark.slow
def test_the_wheel_holds_every_file_of_the_packages(wheel: Path) -> None:
    """Templates, notebooks, figures and specimens travel with the code, and nothing else does."""
    with zipfile.ZipFile(wheel) as archive:
        names = {name for name in archive.namelist() if ".dist-info/" not in name}
        licences = [name for name in archive.namelist() if name.endswith("LICENSE")]
    assert names == _files(ROOT)
    assert licences


@pytest.mark.slow
def test_the_wheel_is_imported_from_where_it_is_installed(installed: Path, tmp_path: Path) -> None:
    """In the empty environment the three packages are the wheel's, not the checkout's."""
    code = f"import {', '.join(PACKAGES)}; print({', '.join(f'{name}.__file__' for name in PACKAGES)}, sep='\\n')"
    places = _run(installed / "python", "-c", code, cwd=tmp_path).stdout.split()
    assert all(Path(place).is_relative_to(installed.parent) for place in places)
    assert len(places) == len(PACKAGES)


DIGEST = """
from autograder.engine.corpus import draw_corpus
from autograder.stages.catalogue import all_stages
print(draw_corpus(all_stages(), seed=7, examples=60).digest)
"""
# Hypothesis likes to draw the literals that it reads in modules which are not installed packages.
BESIDE = "WHOLE, REAL, WORD, DATA = [-9, 7, 137, 4096], [0.625, -3.5, 1e-9, 12.75], 'odometry', b'0.1'\n"


@pytest.mark.slow
def test_checkout_and_wheel_draw_the_same_corpus(installed: Path, tmp_path: Path) -> None:
    """The cases of a run depend on the seed only, not on where the code lies or what is imported beside it."""
    (tmp_path / "beside.py").write_text(BESIDE, encoding="utf-8")
    here = _run(sys.executable, "-c", DIGEST, cwd=ROOT, home=tmp_path).stdout
    there = _run(installed / "python", "-c", DIGEST, cwd=tmp_path).stdout
    beside = _run(installed / "python", "-c", f"import beside{DIGEST}", cwd=tmp_path).stdout
    assert len(here.strip()) == 64
    assert {there, beside} == {here}


@pytest.fixture(scope="session")
def demo(installed: Path, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    """Run `autograder demo` from the wheel alone, in an empty home; return where, and what it said."""
    place = tmp_path_factory.mktemp("demo")
    (place / "home").mkdir()
    return place, _run(installed / "autograder", "demo", cwd=place, home=place / "home").stdout


@pytest.mark.slow
def test_the_demo_runs_outside_the_checkout(demo: tuple[Path, str]) -> None:
    """It grades its class, what it says it wrote is there, and nothing else is."""
    place, said = demo
    named = [place / word for word in re.findall(r"^ +(slam1d-demo/\S+)", said, flags=re.MULTILINE)]
    assert len(named) >= 7
    assert all(path.exists() for path in named), named
    results = list((place / "slam1d-demo" / "results").glob("*.json"))
    rows = (place / "slam1d-demo" / "grades.csv").read_text(encoding="utf-8").splitlines()
    assert len(results) == len(rows) - 1 >= 14
    assert {path.name for path in place.iterdir()} == {"home", "slam1d-demo"}
    assert not list((place / "home").iterdir())


@pytest.mark.slow
def test_the_last_line_of_the_demo_can_be_typed(installed: Path, demo: tuple[Path, str], tmp_path: Path) -> None:
    """It grades the demo's class again, into another folder."""
    place, said = demo
    line = said.splitlines()[-1].strip()
    assert line.startswith(f"{installed / 'autograder'} grade slam1d-demo/class -o ")
    shutil.copytree(place / "slam1d-demo" / "class", tmp_path / "slam1d-demo" / "class")
    _run("bash", "-c", f"{line} --examples 1 --only ada_lindqvist", cwd=tmp_path)
    assert (tmp_path / "graded" / "grades.csv").exists()


@pytest.mark.slow
def test_the_readme_shows_a_failing_listing_as_it_is_printed(demo: tuple[Path, str]) -> None:
    """The listing of the front page is what the demo prints, character by character."""
    _, said = demo
    (listing,) = re.findall(r"^```text\n(\d\. A wrong answer.*?)```", README, flags=re.MULTILINE | re.DOTALL)
    begin = said.find(listing.splitlines()[0])
    assert said[begin:].startswith(listing), (
        f"README.md shows another listing than:\n{said[begin:][: 2 * len(listing)]}"
    )
