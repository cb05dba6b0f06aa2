"""House rules that a reader would otherwise have to check by eye: sizes, names, paths, folders of cases."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
SPECIMENS = ROOT / "autograder" / "specimens"
CODE = ("assignment", "autograder", "reference_solution", "tests")
NOT_OURS = {
    ".git",
    ".venv",
    ".venv-floors",
    "__pycache__",
    ".hypothesis",
    ".mypy_cache",
    ".pytest_cache",
    ".ruff_cache",
    "dist",
    "demo",
}
MOST_LINES = {"assignment": 300, "autograder": 300, "reference_solution": 300, "tests": 400}  # the rule is about 250
LONGER = {
    "assignment/posegraph.py": 340,  # a student gets one file of given code, most of it docstring
    "autograder/render/figure.py": 310,  # one file of pictures, which the notebooks carry along
    "assignment/self_check.py": 600,  # and one file of checks and hints, which stands alone; a third of it is text
}
SILENCERS = r"# (?:ruff: )?noqa(?:: [A-Z]+\d+(?:, ?[A-Z]+\d+)*)?|# type: ignore(?:\[[\w, -]+\])?|# pragma: no \w+"
VAGUE = {"utils", "util", "helpers", "helper", "common", "misc"}


def files(root: Path) -> Iterator[Path]:
    """Walk over the files that are ours."""
    for path in sorted(root.iterdir()):
        if path.is_dir() and path.name not in NOT_OURS and not path.name.endswith(".egg-info"):
            yield from files(path)
        elif path.is_file() and path.name != ".coverage":
            yield path


def modules() -> list[Path]:
    """List the Python files that are written by hand."""
    return [
        path for name in CODE for path in files(ROOT / name) if path.suffix == ".py" and SPECIMENS not in path.parents
    ]


def empty_folders(specimens: Path) -> list[str]:
    """Name the folders of specimens that hold no case."""
    folders = [path for path in sorted(specimens.iterdir()) if path.is_dir() and path.name != "__pycache__"]
    return [folder.name for folder in folders if not any(path.name != "__init__.py" for path in files(folder))]


def test_a_file_holds_one_idea() -> None:
    """No module is longer than a reader takes in at once."""
    lengths = {path.relative_to(ROOT).as_posix(): len(path.read_text("utf-8").splitlines()) for path in modules()}
    most = {name: LONGER.get(name, MOST_LINES[name.split("/")[0]]) for name in lengths}
    long = {name: lines for name, lines in lengths.items() if lines > most[name]}
    assert not long, f"split these: {long}"


def test_a_file_is_named_for_its_idea() -> None:
    """No module has a name under which anything could stand."""
    vague = [str(path.relative_to(ROOT)) for path in modules() if VAGUE & {path.stem, path.parent.name}]
    assert not vague, f"name these for what they hold: {vague}"


def bare_exceptions(text: str) -> list[str]:
    """Find the comments that silence a checker and do not say why."""
    lines = [line[line.index("#") :] for line in text.splitlines() if re.search(SILENCERS, line)]
    return [line for line in lines if len(re.sub(SILENCERS, "", line).strip(" #-()")) < len("frozen")]


def test_an_exception_gives_its_reason() -> None:
    """Whoever silences a checker says why on the same line."""
    bare = [
        f"{path.relative_to(ROOT)}: {line}" for path in modules() for line in bare_exceptions(path.read_text("utf-8"))
    ]
    assert not bare, "\n".join(bare)


def test_a_bare_exception_is_seen() -> None:
    """A silencer with a reason passes, one without does not."""
    mark = "# no" + "qa: "
    assert not bare_exceptions(f"x = 1  {mark}E501, PLR2004 - a table is read across")
    assert not bare_exceptions(f"x = 1  {mark}E501 (a table is read across)")
    assert bare_exceptions(f"x = 1  {mark}E501, PLR2004") == [f"{mark}E501, PLR2004"]


@pytest.mark.skipif(len(ROOT.parts) < 3, reason="the checkout's path is too short to be told from other text")
def test_no_file_knows_where_it_was_written() -> None:
    """No file holds the path of this checkout."""
    here = str(ROOT).encode()
    found = [str(path.relative_to(ROOT)) for path in files(ROOT) if here in path.read_bytes()]
    assert not found, f"these name a path of this machine: {found}"


@pytest.mark.skipif(not SPECIMENS.is_dir(), reason="no specimens yet")
def test_every_folder_of_specimens_holds_a_case() -> None:
    """An empty folder of specimens would be a test of nothing."""
    assert not empty_folders(SPECIMENS)


def test_an_empty_folder_of_specimens_is_seen(tmp_path: Path) -> None:
    """A folder with nothing but an __init__.py counts as empty."""
    for name in ("full", "bare", "marked"):
        (tmp_path / name).mkdir()
    (tmp_path / "full" / "case.py").touch()
    (tmp_path / "marked" / "__init__.py").touch()
    assert empty_folders(tmp_path) == ["bare", "marked"]
