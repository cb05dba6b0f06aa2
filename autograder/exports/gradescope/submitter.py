"""Who handed in, by submission_metadata.json, and which variant this student has on record."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from autograder.problems.ledger import Ledger
from autograder.problems.roster import Student, normal_id

_LARGEST = 64 * 2**20  # it repeats the results of earlier attempts


def submitters(path: Path) -> list[tuple[str, ...]]:
    """Read what Gradescope knows of everybody who handed in: address and SID; [] where it says nothing.

    Nothing of it is trusted to be there: a file that cannot be read costs the student nothing.
    """
    try:
        if path.stat().st_size > _LARGEST:
            return []
        users = json.loads(path.read_text(encoding="utf-8"))["users"]
        return [_names(user) for user in users if isinstance(user, dict)]
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return []


def student_id(people: Iterable[tuple[str, ...]], roster: Iterable[Student], ledger: Ledger | None) -> str | None:
    """Find the id on record of the first person who has one: by address or by id, nothing else.

    Parameters
    ----------
    people : iterable
        What `submitters` returned.
    roster : iterable of Student
        Whose address is which id.
    ledger : Ledger, optional
        The variants; its ids count, too.
    """
    known = {}
    for student in roster:
        for key in (student.student_id, student.email):
            if key:
                known[normal_id(key).casefold()] = student.student_id
    for names in people:
        for name in names:
            found = known.get(normal_id(name).casefold())
            if found is not None:
                return found
            variant = None if ledger is None else ledger.get(name)
            if variant is not None:
                return variant.student_id
    return None


def _names(user: dict[str, Any]) -> tuple[str, ...]:
    """Take the address and the SID; `id` is Gradescope's own number, which may be somebody else's id."""
    return tuple(str(user[key]) for key in ("email", "sid") if isinstance(user.get(key), str | int))


def slim_roster(students: Iterable[Student]) -> bytes:
    r"""Write a roster of ids and addresses only: names have no use in the archive.

    Examples
    --------
    >>> slim_roster([Student("s1", "Ann Lee", "ann@uni.edu")])
    b'student_id,email\ns1,ann@uni.edu\n'
    """
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    rows = [(student.student_id, student.email) for student in students]
    writer.writerows([("student_id", "email"), *rows] if rows else [])
    return file.getvalue().encode()
