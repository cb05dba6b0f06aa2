"""Files that appear whole or not at all: for every room that writes."""

from __future__ import annotations

import os
from pathlib import Path

from autograder.errors import UsageError


def sweep(folder: Path) -> None:
    """Remove the drafts that processes left in a folder when they were killed."""
    for draft in folder.glob(".*.part"):
        writer = draft.name.split(".")[-2]
        if not (writer.isdigit() and _lives(int(writer))):
            draft.unlink(missing_ok=True)


def _lives(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except OSError:
        return True  # somebody else's
    return pid != os.getpid()


def write_whole(path: Path, data: bytes) -> None:
    """Write a file so that a reader sees the old bytes or the new ones, never a part.

    Raises
    ------
    UsageError
        Where the disk is full or the folder cannot be written; the old file is still there.
    """
    draft = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        draft.write_bytes(data)
        draft.replace(path)
    except OSError as error:
        draft.unlink(missing_ok=True)
        raise UsageError(f"{path} could not be written ({error.strerror}); what was there before is kept.") from None
