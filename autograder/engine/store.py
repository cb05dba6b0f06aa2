"""The results on disk: one JSON file a submission, written whole or not at all."""

from __future__ import annotations

import hashlib
import os
import platform
import sys
from collections.abc import Iterable
from functools import cache
from pathlib import Path

import msgspec
import numpy as np

import autograder
from autograder.errors import UsageError
from autograder.verdicts import Result, decode, encode
from autograder.writing import make_private, sweep, write_whole

# Rooms that are left out of the digest of the code: specimens are data, and the others come after the verdicts.
SHOWING = {"specimens", "reports", "exports", "marking", "desk", "commands", "audit", "cli.py", "__main__.py", "render"}
_EFFECTIVE = os.access in os.supports_effective_ids


class RunRecord(msgspec.Struct, frozen=True, kw_only=True):
    """What run.json holds: everything that another run needs to be the same, and how long this one took."""

    seed: int
    examples: int
    exam: str
    confinement: str
    locks: str = ""
    versions: dict[str, str]
    settings: dict[str, object]
    submissions: int
    graded_now: int
    reused: int
    interrupted: bool
    seconds: float


class Store:
    """The folder OUT of a run.

    Parameters
    ----------
    out : Path
        Created if it does not exist.

    Raises
    ------
    UsageError
        Where the folder cannot be written.
    """

    def __init__(self, out: Path) -> None:
        self.out = out
        self.results = out / "results"
        try:
            make_private(out)
            make_private(self.results)
        except OSError as error:
            raise UsageError(
                f"{out} cannot be used as output folder ({error.strerror}); choose another with -o."
            ) from None
        if not all(os.access(folder, os.W_OK, effective_ids=_EFFECTIVE) for folder in (out, self.results)):
            raise UsageError(f"{out} cannot be written by this user; choose another with -o.")
        sweep(out)
        sweep(self.results)

    def load(self, submission: str, fingerprint: str) -> Result | None:
        """Return the stored result if it is whole, from the same work, and not a fault of ours."""
        result = self.read(submission)
        if result is None or result.status == "grader_error":
            return None
        return result if result.fingerprint == fingerprint else None

    def read(self, submission: str) -> Result | None:
        """Return the stored result whatever work it is from; None where there is none that can be read."""
        try:
            result = decode((self.results / f"{submission}.json").read_bytes())
        except (OSError, msgspec.MsgspecError):
            return None
        return result if result.submission == submission else None

    def save(self, result: Result) -> None:
        """Write one result."""
        write_whole(self.results / f"{result.submission}.json", encode(result))

    def save_record(self, record: RunRecord) -> None:
        """Write run.json."""
        write_whole(self.out / "run.json", msgspec.json.format(msgspec.json.encode(record), indent=2) + b"\n")


@cache
def code_digest() -> str:
    """Return a digest of the code that judges, so that results of another grader are noticed."""
    root = Path(autograder.__file__).parent.parent
    digest = hashlib.sha256()
    files = [root / "assignment/posegraph.py", root / "reference_solution/slam1d.py"]
    files += sorted(path for path in (root / "autograder").rglob("*.py") if _judges(path.relative_to(root)))
    files.append(root / "autograder/diagnosis/gallery.json")
    for path in files:
        digest.update(path.relative_to(root).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()


def _judges(path: Path) -> bool:
    """Whether a module can change a verdict; what only shows or passes on verdicts cannot."""
    return not SHOWING & set(path.parts)


def versions() -> dict[str, str]:
    """Return the versions that results may depend on."""
    return {
        "autograder": autograder.__version__,
        "code": code_digest()[:16],
        "python": platform.python_version(),
        "numpy": np.__version__,
        "platform": f"{sys.platform} {platform.machine()}",
    }


def fingerprint(parts: Iterable[str]) -> str:
    """Identify the work that led to a result: the same parts, the same bytes."""
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()
