"""Files that appear whole or not at all: for every room that writes."""

from __future__ import annotations

import contextlib
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


def make_private(folder: Path) -> None:
    """Make a folder and those above it, where they are missing; only their owner may look in, whatever the umask is."""
    if not folder.is_dir():
        make_private(folder.parent)
        folder.mkdir(mode=0o700, exist_ok=True)
        folder.chmod(0o700)


def make_folder(out: Path) -> None:
    """Make the folder for what a command writes, for its owner alone.

    Raises
    ------
    UsageError
        Where none can be made there.
    """
    try:
        make_private(out)
    except OSError as error:
        raise UsageError(f"-o {out}: no folder can be made there ({error.strerror}); choose another.") from error
    if not os.access(out, os.W_OK):
        raise UsageError(f"-o {out}: the folder cannot be written; choose another.")


def write_whole(path: Path, data: bytes) -> None:
    """Write a file so that a reader sees the old bytes or the new ones, never a part.

    Only its owner may read it, whatever the umask is; a file that somebody has opened to others stays open.

    Raises
    ------
    UsageError
        Where the disk is full or the folder cannot be written; the old file is still there.
    """
    draft = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        with os.fdopen(_for_the_owner(draft), "wb") as file:
            file.write(data)
        if mode := _opened(path):
            draft.chmod(mode)
        draft.replace(path)
    except OSError as error:
        with contextlib.suppress(OSError):  # a disk that became read-only keeps its drafts, too
            draft.unlink(missing_ok=True)
        raise UsageError(f"{path} could not be written ({error.strerror}); what was there before is kept.") from None


def _for_the_owner(draft: Path) -> int:
    draft.unlink(missing_ok=True)
    return os.open(draft, os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0), 0o600)


def _opened(path: Path) -> int:
    """Return the mode of a file that people have opened to others; 0 where there is none."""
    try:
        mode = path.stat().st_mode & 0o666
    except OSError:
        return 0
    return mode if mode & 0o066 else 0
