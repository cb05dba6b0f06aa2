"""Folders on disk: what lies in them, and files opened so that nothing can block or lead elsewhere."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from functools import partial
from pathlib import Path

from autograder.errors import RejectedUpload, UsageError
from autograder.intake.tree import SUBMISSION_SUFFIXES, Entry, Tree, is_noise, sort_key, split_suffix

MAX_ENTRIES = 100_000
MAX_DEPTH = 24
CHUNK = 1 << 20

_KINDS = (
    (stat.S_ISDIR, "a folder"),
    (stat.S_ISFIFO, "a named pipe"),
    (stat.S_ISSOCK, "a socket"),
    (stat.S_ISCHR, "a device"),
    (stat.S_ISBLK, "a device"),
)


def read_regular(path: Path, limit: int) -> bytes:
    """Read at most ``limit + 1`` bytes of a regular file; raises RejectedUpload for anything else.

    The open never waits (a named pipe would) and never follows a link at the last step.
    """
    flags = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_BINARY", 0)
    try:
        descriptor = os.open(path, flags)
    except OSError as error:
        raise RejectedUpload(f"cannot be opened ({_reason(error)}); check its permissions") from None
    try:
        if problem := _kind_problem(os.fstat(descriptor).st_mode):
            raise RejectedUpload(problem)
        chunks: list[bytes] = []
        left = limit + 1
        while left and (chunk := os.read(descriptor, min(left, CHUNK))):
            chunks.append(chunk)
            left -= len(chunk)
    except OSError as error:
        raise RejectedUpload(f"cannot be read ({_reason(error)}); check its permissions") from None
    finally:
        os.close(descriptor)
    return b"".join(chunks)


def file_entry(path: Path) -> Entry:
    """Return the entry of one file that was named by the user; a link is followed, since the user chose it."""
    parts = (path.name or path.resolve().name,)
    try:
        target = path.resolve(strict=True)
        problem = _kind_problem(target.stat().st_mode)
    except (OSError, RuntimeError) as error:
        return Entry(parts, str(path), problem=f"cannot be opened ({_reason(error)}); check its permissions")
    return Entry(parts, str(target), partial(read_regular, target), problem)


def folder_tree(root: Path) -> Tree:
    """List a folder with everything below it; raises UsageError where it cannot be listed or is far too large."""
    base = root.resolve()
    entries: list[Entry] = []
    folders: set[tuple[str, ...]] = set()
    for seen, (entry, is_folder) in enumerate(_walk(base, ()), start=1):
        if seen > MAX_ENTRIES:
            raise UsageError(
                f"{root} holds more than {MAX_ENTRIES} files; give the folder of the submissions themselves."
            )
        if is_folder:
            folders.add(entry.parts)
        else:
            entries.append(entry)
    entries.sort(key=lambda entry: sort_key(entry.parts))
    return Tree(name=base.name, entries=tuple(entries), folders=frozenset(folders))


def _walk(folder: Path, parts: tuple[str, ...]) -> Iterator[tuple[Entry, bool]]:
    """Yield (entry, is it a folder) for everything below `folder`; links to folders are never walked."""
    try:
        with os.scandir(folder) as scan:
            found = sorted(scan, key=lambda item: item.name)
    except OSError as error:
        if not parts:
            raise UsageError(f"{folder.name} cannot be listed ({_reason(error)}); check its permissions.") from None
        problem = f"is a folder that cannot be listed ({_reason(error)}); check its permissions"
        yield Entry(parts, str(folder), problem=problem, closed_folder=True), False
        return
    if parts and any(item.name == "pyvenv.cfg" for item in found):
        return  # an installed environment: thousands of files, none of them handed in
    for item in found:
        path, here = folder / item.name, (*parts, item.name)
        if item.is_symlink():
            if not is_noise(item.name):
                yield _link(path, here), False
        elif not item.is_dir(follow_symlinks=False):
            if not is_noise(item.name):
                yield Entry(here, str(path), partial(read_regular, path), _item_problem(item)), False
        elif split_suffix(item.name)[1] in SUBMISSION_SUFFIXES and not is_noise(item.name):
            yield Entry(here, str(path), problem=_wrong_kind("a folder")), False
        else:
            yield Entry(here, str(path)), True
            if is_noise(item.name):
                continue
            if len(here) > MAX_DEPTH:
                raise UsageError(f"{folder.name} is nested over {MAX_DEPTH} folders deep; give one further down.")
            yield from _walk(path, here)


def _link(path: Path, parts: tuple[str, ...]) -> Entry:
    """Return the entry of a link: readable only where it stays below the folder that it lies in.

    A link into the folder of somebody else would hand in their work.
    """
    try:
        target = path.resolve(strict=True)
        mode = target.stat().st_mode
    except (OSError, RuntimeError):
        return Entry(parts, str(path), problem="is a link that leads nowhere; hand in the file itself")
    if not target.is_relative_to(path.parent) or stat.S_ISDIR(mode):
        words = "is a link that leads out of its folder" if not stat.S_ISDIR(mode) else "is a link to a folder"
        return Entry(parts, str(path), problem=f"{words}; hand in the file itself", closed_folder=stat.S_ISDIR(mode))
    return Entry(parts, str(target), partial(read_regular, target), _kind_problem(mode))


def _item_problem(item: os.DirEntry[str]) -> str:
    try:
        return _kind_problem(item.stat(follow_symlinks=False).st_mode)
    except OSError as error:
        return f"cannot be opened ({_reason(error)})"


def _kind_problem(mode: int) -> str:
    if stat.S_ISREG(mode):
        return ""
    return next((_wrong_kind(words) for test, words in _KINDS if test(mode)), _wrong_kind("no regular file"))


def _wrong_kind(words: str) -> str:
    return f"is {words}, expected a file; hand in the file itself"


def _reason(error: OSError | RuntimeError) -> str:
    return getattr(error, "strerror", None) or type(error).__name__
