"""The way in: make explains itself, says what a machine lacks, and sets up once, from a lock with exact versions."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).resolve().parent.parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
LOCKS = {"build": "requirements.lock", "dev": "requirements-dev.lock", "mutants": "requirements-mutants.lock"}


def _text(lock: str) -> str:
    return (ROOT / lock).read_text(encoding="utf-8")


def _locked(lock: str) -> dict[str, set[str]]:
    found: dict[str, set[str]] = {}
    for name, version in re.findall(r"^([\w.-]+)==([^\s;]+)", _text(lock), flags=re.MULTILINE):
        found.setdefault(canonicalize_name(name), set()).add(version)
    return found


def _group(name: str) -> list[str]:
    lines = PROJECT["dependency-groups"][name]
    return [each for line in lines for each in (_group(line["include-group"]) if isinstance(line, dict) else [line])]


def _required() -> list[tuple[str, Requirement]]:
    base = [*PROJECT["project"]["dependencies"], *PROJECT["build-system"]["requires"]]
    return [(lock, Requirement(line)) for group, lock in LOCKS.items() for line in [*base, *_group(group)]]


@pytest.mark.parametrize(("lock", "requirement"), _required(), ids=str)
def test_the_lock_holds_what_the_project_asks_for(lock: str, requirement: Requirement) -> None:
    """Every requirement, the build backend included, is locked to versions that satisfy it."""
    versions = _locked(lock).get(canonicalize_name(requirement.name), set())
    assert versions, f"{requirement} is not in {lock}; run `make lock`"
    assert all(requirement.specifier.contains(version) for version in versions), f"{requirement}: run `make lock`"


@pytest.mark.parametrize("lock", LOCKS.values())
def test_the_lock_is_exact_and_names_no_host(lock: str) -> None:
    """Every package has one version and hashes; where it is fetched from is the machine's matter."""
    packages = re.split(r"^(?=\w)", re.sub(r"^ *#.*\n", "", _text(lock), flags=re.MULTILINE), flags=re.MULTILINE)[1:]
    assert len(packages) > 25
    assert all(re.match(r"[\w.-]+==\S+", package) and "--hash=sha256:" in package for package in packages)
    assert "://" not in _text(lock)
    assert "index" not in _text(lock)


def test_the_locks_agree() -> None:
    """What grades, what tests and what mutates run with the same versions; each lock holds the one before."""
    run, dev, mutants = map(_locked, LOCKS.values())
    assert run.items() <= dev.items() <= mutants.items()


def test_the_demo_installs_no_tool_of_development() -> None:
    """A first look costs what grading needs, and what builds the program."""
    assert (
        not {"pytest", "ruff", "mypy", "distributed", "ipykernel", "cosmic-ray"} & _locked("requirements.lock").keys()
    )
    assert "cosmic-ray" not in _locked("requirements-dev.lock")


def test_every_exception_to_a_rule_gives_its_reason() -> None:
    """A rule that is switched off for a file or a tool says why on the same line."""
    lines = (ROOT / "pyproject.toml").read_text(encoding="utf-8").splitlines()
    off = [line for line in lines if re.match(r' +"[A-Z]+\d+", +#|(ignore_|extend-exclude|exclude = \["\^|omit)', line)]
    assert len(off) > 10
    assert all("#" in line for line in off), [line for line in off if "#" not in line]


@pytest.fixture
def place(tmp_path: Path) -> Path:
    """Make a folder with what make looks at."""
    folder = tmp_path / "a folder (with blanks)"
    folder.mkdir()
    for name in ("Makefile", "pyproject.toml", *LOCKS.values()):
        (folder / name).write_bytes((ROOT / name).read_bytes())
    return folder


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
    installs = [line for line in lines if ".lock" in line and " -r " in line]
    assert len(installs) == 4
    assert all("$(FROM_LOCK)" in line or "install --no-cache-dir --no-input --no-deps" in line for line in installs)
    assert "FROM_LOCK := $(PIP) install --no-deps --require-hashes" in lines


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


def _pretend_ready(place: Path, made_for: str, environment: str = ".venv") -> None:
    (place / environment / "bin").mkdir(parents=True)
    for name in ("python", "pip"):
        (place / environment / "bin" / name).touch()
    for name, text in (("made-for", made_for), ("files", "2"), ("ready", "")):
        (place / environment / name).write_text(f"{text}\n", encoding="utf-8")


def test_a_second_run_does_no_set_up(place: Path) -> None:
    """An environment that is newer than the lock is left as it is."""
    _pretend_ready(place, f"{place} python3")
    run = _make(place, ".venv/ready")
    assert (run.returncode, run.stderr) == (0, "")
    assert "up to date" in run.stdout


def test_a_copied_environment_is_made_anew(place: Path) -> None:
    """An environment from another folder is not used."""
    _pretend_ready(place, "/elsewhere python3")
    assert "setting up" in _make(place, "-n", ".venv/ready").stdout


def test_a_half_deleted_environment_is_made_anew(place: Path) -> None:
    """Where files of it are gone, or its set-up was interrupted, nothing of it is trusted."""
    _pretend_ready(place, f"{place} python3")
    (place / ".venv" / "bin" / "pip").unlink()
    assert "rm -rf .venv\n" in _make(place, "-n", ".venv/ready").stdout
    shutil.rmtree(place / ".venv" / "bin")
    assert "rm -rf .venv\n" in _make(place, "-n", ".venv/ready").stdout
    shutil.rmtree(place / ".venv")
    _pretend_ready(place, f"{place} python3")
    for name in ("files", "ready"):
        (place / ".venv" / name).unlink()
    assert "rm -rf .venv\n" in _make(place, "-n", ".venv/ready").stdout


def test_another_python_has_an_environment_of_its_own(place: Path) -> None:
    """The first one is neither used nor thrown away, and is found again."""
    _pretend_ready(place, f"{place} python3")
    planned = _make(place, "-n", "demo", "PYTHON=python3.13").stdout
    assert ".venv-python3.13/ready" in planned
    assert not re.search(r"rm -rf .*\.venv(\s|$)", planned)
    assert "python -m autograder demo" in planned
    assert "up to date" in _make(place, ".venv/ready").stdout
    assert ".venv-_opt_my_python/bin/python" in _make(place, "-n", "demo", "PYTHON=/opt/my python").stdout


def test_this_environment_is_recent_enough() -> None:
    """The interpreter that runs the tests is one that the project supports."""
    assert sys.version_info >= (3, 11)
