"""Names that tell nothing, for marking without knowing whose answer it is; the key stays with the run."""

from __future__ import annotations

import csv
import io
import secrets
from collections.abc import Iterable
from pathlib import Path

from autograder.marking.spreadsheets import bare, cell
from autograder.marking.tables import read_table
from autograder.writing import write_whole

FILE = "anonymous.csv"
COLUMNS = ("anonymous", "submission")
_LETTERS = "BCDFGHJKLMNPQRSTVWXZ"  # no vowels: no words
_LENGTH = 6


def read_key(out: Path) -> dict[str, str]:
    """Return anonymous name -> submission; empty where nobody has asked for them."""
    path = out / FILE
    if not path.exists():
        return {}
    return {row["anonymous"]: bare(row["submission"]) for row in read_table(path, COLUMNS)}


def anonymous_names(out: Path, submissions: Iterable[str]) -> dict[str, str]:
    """Return submission -> anonymous name; names are drawn once, kept in the run's folder, and say nothing."""
    known = {submission: name for name, submission in read_key(out).items()}
    missing = [submission for submission in submissions if submission not in known]
    taken = set(known.values())
    for submission in missing:
        name = _name()
        while name in taken:
            name = _name()
        taken.add(name)
        known[submission] = name
    if missing:
        file = io.StringIO()
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows(sorted((name, cell(submission)) for submission, name in known.items()))
        write_whole(out / FILE, file.getvalue().encode())
    return known


def _name() -> str:
    return "".join(secrets.choice(_LETTERS) for _ in range(_LENGTH))
