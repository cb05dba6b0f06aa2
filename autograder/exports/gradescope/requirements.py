"""The locked versions that grading needs, without those that only development, or drawing an exam, needs."""

from __future__ import annotations

import importlib.metadata
import re
from pathlib import Path

from autograder.errors import UsageError

DISTRIBUTION = "slam1d-homework"
ONLY_DRAWS = "hypothesis"  # the archive carries an exam that is drawn already
_PACKAGE = re.compile(r"([A-Za-z0-9._-]+)==")
_VIA = re.compile(r"#(?: +via)? +(\S.*)")


def runtime_lock(text: str, name: str) -> str:
    r"""Keep the packages of a lock file that the program itself needs, and what these need.

    Raises
    ------
    UsageError
        Where the file does not say what needs what.

    Examples
    --------
    >>> needed = "numpy==2.4\n    # via slam1d-homework (pyproject.toml)\n"
    >>> runtime_lock(needed + "ruff==1\n    # via slam1d-homework (pyproject.toml:dev)\n", "requirements.lock")
    'numpy==2.4\n    # via slam1d-homework (pyproject.toml)\n'
    """
    blocks: dict[str, str] = {}
    current = ""
    for line in text.splitlines(keepends=True):
        found = _PACKAGE.match(line)
        if found:
            current = "" if found[1] == ONLY_DRAWS else found[1]
        if current:
            blocks[current] = blocks.get(current, "") + line
    wanted: set[str] = set()
    while True:
        more = {
            package
            for package, block in blocks.items()
            if package not in wanted and any(_needs(parent, wanted) for parent in _parents(block))
        }
        if not more:
            break
        wanted |= more
    if not wanted:
        raise UsageError(f"{name} does not say which packages {DISTRIBUTION} needs; write it anew: make lock.")
    return "".join(block for package, block in blocks.items() if package in wanted)


def installed_lock() -> str:
    """List the versions of this environment, where there is no lock file: an installed wheel carries none."""
    wanted: dict[str, str] = {}
    queue = [DISTRIBUTION]
    while queue:
        for line in importlib.metadata.requires(queue.pop()) or []:
            name, _, marker = line.partition(";")
            found = re.match(r"[A-Za-z0-9._-]+", name)
            if found is None or "extra" in marker or found[0] in {*wanted, ONLY_DRAWS}:
                continue
            try:
                wanted[found[0]] = importlib.metadata.version(found[0])
            except importlib.metadata.PackageNotFoundError:
                continue  # for another system or another Python
            queue.append(found[0])
    return "".join(f"{name}=={version}\n" for name, version in sorted(wanted.items()))


def locked(path: Path | None) -> tuple[str, str]:
    """Return the requirements to install, and where they are from."""
    beside = Path(__file__).resolve().parents[3] / "requirements.lock"
    if path is None and not beside.is_file():
        return installed_lock(), "the versions of this environment"
    chosen = path or beside
    try:
        return runtime_lock(chosen.read_text(encoding="utf-8"), chosen.name), chosen.name
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "it is not UTF-8"
        raise UsageError(
            f"{chosen} cannot be read ({reason}); expected a lock file as `make lock` writes it."
        ) from None


def _parents(block: str) -> list[str]:
    return [found[1].strip() for line in block.splitlines() if (found := _VIA.search(line)) and found[1] != "via"]


def _needs(parent: str, wanted: set[str]) -> bool:
    return parent in wanted or parent == f"{DISTRIBUTION} (pyproject.toml)"
