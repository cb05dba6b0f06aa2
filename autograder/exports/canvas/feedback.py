"""Feedback for Canvas's "Upload Submissions": files under the names of the uploads, which say whose they are.

Canvas finds student and upload by the two numbers in a name, and shows the file to the student under the
name of the upload. So each file is what its name promises: text in comments for a .py, a notebook for an .ipynb.
"""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

from autograder.errors import UsageError
from autograder.exports.bundle import bundle
from autograder.exports.pairing import listing
from autograder.verdicts import Result

_UPLOAD = re.compile(r"(?P<name>[^_]+)(?:_LATE)?_(?P<user>\d+)_(?P<attachment>\d+)_(?P<file>.+)", re.DOTALL)


@dataclass(frozen=True)
class Returned:
    """The archive to upload, and what a human should know."""

    data: bytes
    notes: tuple[str, ...]


def feedback_archive(
    uploads: Sequence[str], name: str, owners: Mapping[str, Result], texts: Mapping[str, str]
) -> Returned:
    """Pack a file for every student whose upload Canvas can find again.

    Parameters
    ----------
    uploads : sequence of str
        Names of the files in Canvas's submissions.zip.
    name : str
        What messages call that archive.
    owners : mapping
        Canvas's number of a student -> the student's result.
    texts : mapping
        Submission -> feedback as text.

    Raises
    ------
    UsageError
        Where no file of the archive belongs to a graded student.
    """
    newest = newest_uploads(uploads, owners)
    if not newest:
        raise UsageError(
            f"{name} holds no upload of anybody who was graded; expected the submissions.zip of this assignment "
            "as Canvas made it, with names like doejane_101_2001_slam1d.py."
        )
    files = {upload: content(upload, texts[owners[user].submission]) for user, upload in newest.items()}
    without = [result.submission for user, result in owners.items() if user not in newest]
    notes = (f"No upload in {name}: {listing(without)}; Canvas could not take a file for them.",) if without else ()
    return Returned(bundle(files), notes)


def newest_uploads(uploads: Sequence[str], users: Collection[str]) -> dict[str, str]:
    """Return for each of these numbers of students the name of the newest upload.

    Examples
    --------
    >>> newest_uploads(["doejane_101_7_a.py", "doejane_101_9_b.py", "notes.txt"], ["101"])
    {'101': 'doejane_101_9_b.py'}
    """
    newest: dict[str, tuple[int, str]] = {}
    for path in uploads:
        found = _UPLOAD.fullmatch(path)
        if found is not None and "/" not in path and found["user"] in users:
            attachment = (int(found["attachment"]), path)
            newest[found["user"]] = max(newest.get(found["user"], attachment), attachment)
    return {user: upload for user, (_, upload) in newest.items()}


def content(file: str, text: str) -> bytes:
    r"""Write feedback as a file of the kind that a name promises.

    Examples
    --------
    >>> content("slam1d.py", "75 of 90 points\n")
    b'# 75 of 90 points\n'
    >>> json.loads(content("slam1d.ipynb", "75 of 90 points\n"))["cells"][0]["cell_type"]
    'markdown'
    """
    suffix = file.rpartition(".")[2].lower()
    if suffix == "py":
        lines = ("".join(char if char.isprintable() else " " for char in line) for line in text.splitlines())
        return "".join(f"# {line}".rstrip() + "\n" for line in lines).encode()
    if suffix == "ipynb":
        fence = "`" * (max((len(run) for run in re.findall("`+", text)), default=0) + 3)
        cell = {"cell_type": "markdown", "id": "feedback", "metadata": {}, "source": f"{fence}text\n{text}{fence}"}
        return json.dumps({"cells": [cell], "metadata": {}, "nbformat": 4, "nbformat_minor": 5}, indent=1).encode()
    if suffix == "zip":
        return bundle({"feedback.txt": text.encode()})
    return text.encode()
