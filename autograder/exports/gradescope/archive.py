"""autograder.zip: the grader, the locked versions, the rules of the course, and the two scripts at the root."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from importlib import resources
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

from autograder.exports.bundle import bundle
from autograder.exports.gradescope.requirements import locked
from autograder.exports.gradescope.results import Visibility, failure_json
from autograder.reports.feedback import Policy

PACKAGES = ("assignment", "autograder", "reference_solution")
SCRIPTS = ("setup.sh", "run_autograder")
MEMORY_MIB = 384  # what a submission may take beside a grader of about 250 MiB, in a container of 768 MB
_LEFT_OUT = {"__pycache__", "specimens"}


@dataclass(frozen=True)
class Rules:
    """What holds for every submission that this archive grades.

    `feedback` is None where the course file decides, which may know one policy before the due date and one after it.
    """

    seed: int
    examples: int
    time_limit: float
    memory_mib: int
    feedback: Policy | None
    min_confinement: str
    visibility: Visibility


def autograder_zip(
    rules: Rules,
    *,
    exam: bytes = b"",
    course: bytes = b"",
    ledger: bytes = b"",
    roster: bytes = b"",
    lock: Path | None = None,
) -> tuple[bytes, str]:
    """Pack the archive; return it with the origin of the versions in it.

    Parameters
    ----------
    rules : Rules
        Written down at export, so that a later change of defaults changes no mark.
    exam : bytes
        The exam file: no student waits for a draw, and everybody sits the same exam for ever.
    course, ledger, roster : bytes
        The files of the course; empty where there are none. The secret of a term is never among them.
    lock : Path, optional
        The lock file; without it the one of this checkout, or the versions of this environment.
    """
    versions, origin = locked(lock)
    files: dict[str, bytes] = {
        "requirements.txt": versions.encode(),
        "rules.json": (json.dumps(asdict(rules), indent=2) + "\n").encode(),
        "fallback.json": failure_json(visibility=rules.visibility),
    }
    here = resources.files(__package__ or "")
    files |= {name: (here / name).read_bytes() for name in SCRIPTS}
    for name, data in (("exam", exam), ("course.toml", course), ("ledger.csv", ledger), ("roster.csv", roster)):
        if data:
            files[name] = data
    for package in PACKAGES:
        files |= _tree(resources.files(package), f"packages/{package}")
    return bundle(files, frozenset(SCRIPTS)), origin


def read_rules(path: Path) -> Rules:
    """Read the rules in an unpacked archive."""
    found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return Rules(**found)


def _tree(folder: Traversable, below: str) -> Mapping[str, bytes]:
    found: dict[str, bytes] = {}
    for item in folder.iterdir():
        name = f"{below}/{item.name}"
        if item.name in _LEFT_OUT or item.name.startswith("."):
            continue
        if item.is_dir():
            found |= _tree(item, name)
        elif not item.name.endswith(".pyc"):
            found[name] = item.read_bytes()
    return found
