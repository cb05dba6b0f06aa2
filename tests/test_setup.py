"""The way in: make explains itself, says what a machine lacks, and sets up once, from a lock with exact versions."""

from __future__ import annotations

import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).resolve().parent.parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
LOCK = (ROOT / "requirements.lock").read_text(encoding="utf-8")


def _locked() -> dict[str, list[str]]:
    found: dict[str, list[str]] = {}
    for name, version in re.findall(r"^([\w.-]+)==([^\s;]+)", LOCK, flags=re.MULTILINE):
        found.setdefault(canonicalize_name(name), []).append(version)
    return found


def _required() -> list[Requirement]:
    lines = [*PROJECT["project"]["dependencies"], *PROJECT["build-system"]["requires"]]
    return [Requirement(line) for line in [*lines, *PROJECT["dependency-groups"]["dev"]]]


@pytest.mark.parametrize("requirement", _required(), ids=str)
def test_the_lock_holds_what_the_project_asks_for(requirement: Requirement) -> None:
    """Every requirement, the build backend included, is locked to versions that satisfy it."""
    versions = _locked().get(canonicalize_name(requirement.name), [])
    assert versions, f"{requirement} is not in requirements.lock; run `make lock`"
    assert all(requirement.specifier.contains(version) for version in versions), f"{requirement}: run `make lock`"


def test_the_lock_is_exact_and_names_no_host() -> None:
    """Every package has one version and hashes; where it is fetched from is the machine's matter."""
    packages = re.split(r"^(?=\w)", re.sub(r"^ *#.*\n", "", LOCK, flags=re.MULTILINE), flags=re.MULTILINE)[1:]
    assert len(packages) > 30
    assert all(re.match(r"[\w.-]+==\S+", package) and "--hash=sha256:" in package for package in packages)
    assert "://" not in LOCK
    assert "index" not in LOCK


def test_every_exception_to_a_rule_gives_its_reason() -> None:
    """A rule that is switched off for a file or a tool says why on the same line."""
    lines = (ROOT / "pyproject.toml").read_text(encoding="utf-8").splitlines()
    off = [line for line in lines if re.match(r' +"[A-Z]+\d+", +#|(ignore_|extend-exclude|exclude = \["\^|omit)', line)]
    assert len(off) > 10
    assert all("#" in line for line in off), [line for line in off if "#" not in line]


@pytest.fixture
def place(tmp_path: Path) -> Path:
    """Make a folder with what make looks at."""
    for name in ("Makefile", "pyproject.toml", "requirements.lock"):
        (tmp_path / name).write_bytes((ROOT / name).read_bytes())
    return tmp_path


def _make(place: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        ["make", *arguments],
        cwd=place,
        env={"PATH": "/usr/local/bin:/usr/bin:/bin", "HOME": str(place)},
        capture_output=True,
        text=True,
        check=False,
    )


def _python(place: Path, text: str) -> str:
    fake = place / "fake-python"
    fake.write_text(f"#!/bin/sh\n{text}\n", encoding="utf-8")
    fake.chmod(0o755)
    return f"PYTHON={fake}"


def test_nothing_but_the_lock_is_installed() -> None:
    """Every installation from the lock leaves resolving out: else a newer release outside of the lock stops it."""
    lines = [line for name in ("Makefile", "Dockerfile") for line in (ROOT / name).read_text("utf-8").splitlines()]
    installs = [line for line in lines if "-r requirements.lock" in line]
    assert len(installs) == 2
    assert all("install " in line and "--no-deps --require-hashes" in line for line in installs)


def test_make_alone_explains_itself(place: Path) -> None:
    """It lists every command with what it does, and sets nothing up."""
    run = _make(place)
    assert run.returncode == 0
    for target in ("demo", "test", "bench", "fuzz", "lock", "clean"):
        assert re.search(rf"^make {target} +\w", run.stdout, flags=re.MULTILINE)
    assert not (place / ".venv").exists()


def test_make_says_where_python_is_missing(place: Path) -> None:
    """The name that was looked for and the packages to install are named."""
    run = _make(place, "test", "PYTHON=no-such-python")
    assert run.returncode
    assert "no-such-python was not found" in run.stderr
    assert "apt-get install python3 python3-venv" in run.stderr


def test_make_says_which_python_is_too_old(place: Path) -> None:
    """The version that came and the one that is needed stand in one sentence."""
    run = _make(place, "test", _python(place, 'test "$1" = -V && echo Python 3.9.2; test "$1" = -V'))
    assert run.returncode
    assert "is Python 3.9.2, but 3.11 or newer is needed" in run.stderr


def test_make_says_which_package_brings_venv(place: Path) -> None:
    """Debian splits venv and pip off: their package is named."""
    run = _make(place, "test", _python(place, 'case "$2" in *ensurepip*) exit 1;; esac; exit 0'))
    assert run.returncode
    assert "apt-get install python3-venv" in run.stderr
    assert not (place / ".venv").exists()


def _pretend_ready(place: Path, made_for: str) -> None:
    (place / ".venv").mkdir()
    (place / ".venv" / "made-for").write_text(f"{made_for}\n", encoding="utf-8")
    (place / ".venv" / "ready").touch()


def test_a_second_run_does_no_set_up(place: Path) -> None:
    """An environment that is newer than the lock is left as it is."""
    _pretend_ready(place, f"{place} python3")
    run = _make(place, ".venv/ready")
    assert (run.returncode, run.stderr) == (0, "")
    assert "up to date" in run.stdout


def test_a_copied_environment_is_made_anew(place: Path) -> None:
    """An environment from another folder, or for another Python, is not used."""
    _pretend_ready(place, "/elsewhere python3")
    assert "setting up" in _make(place, "-n", ".venv/ready").stdout


def test_this_environment_is_recent_enough() -> None:
    """The interpreter that runs the tests is one that the project supports."""
    assert sys.version_info >= (3, 11)
