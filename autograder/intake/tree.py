"""What lies in a folder or an archive, as a flat list of files: the one view that every layout reads."""

from __future__ import annotations

import unicodedata
from collections.abc import Callable
from dataclasses import dataclass, field, replace

SUBMISSION_SUFFIXES = (".py", ".ipynb", ".zip")
EXPECTED = "expected one .py, .ipynb or .zip file"
PROVIDED_FILES = frozenset({"posegraph.py", "self_check.py"})  # handed out with the homework, never handed in
HANDED_OUT = PROVIDED_FILES | {"readme.md", "handout.html"}  # what lies in the folder that a student receives
NOISE = frozenset({"__pycache__", "__macosx", "thumbs.db", "desktop.ini"})

Loader = Callable[[int], bytes]


def _unreadable(limit: int) -> bytes:
    raise AssertionError(f"an entry with a problem is never loaded (limit {limit})")


@dataclass(frozen=True)
class Entry:
    """One file of a tree.

    Parameters
    ----------
    parts : tuple of str
        Where it lies below the root, folders first.
    origin : str
        What tells this file from every other one, also across trees; the same file met twice has the same origin.
    load : callable
        ``load(limit)`` returns the bytes, at most ``limit + 1`` of them: one more than allowed says "too large".
        It raises RejectedUpload where they cannot be read.
    problem : str
        Why the file must not be read at all, as the end of a sentence ("is a link ..."); "" where it may.
    closed_folder : bool
        Whether it stands for a whole folder that must not be looked into.
    """

    parts: tuple[str, ...]
    origin: str
    load: Loader = field(default=_unreadable, compare=False)
    problem: str = ""
    closed_folder: bool = False

    @property
    def name(self) -> str:
        """The file's own name."""
        return self.parts[-1]

    @property
    def stem(self) -> str:
        """The file's name without its suffix."""
        return split_suffix(self.name)[0]

    @property
    def suffix(self) -> str:
        """The suffix in lower case, with its dot."""
        return split_suffix(self.name)[1]


@dataclass(frozen=True)
class Tree:
    """All files below one folder or in one archive, noise left out.

    `folders` also holds folders that are empty or not looked into (a ``.git``), because their presence tells layouts
    apart.
    """

    name: str
    entries: tuple[Entry, ...]
    folders: frozenset[tuple[str, ...]] = frozenset()
    archive: bool = False

    def unwrapped(self) -> Tree | None:
        """Return the tree of the only folder at the top, or None where there are files or several folders."""
        tops = {folder[0] for folder in self.folders if not folder[0].startswith(".")}
        tops |= {entry.parts[0] for entry in self.entries if len(entry.parts) > 1}
        if len(tops) != 1 or any(len(entry.parts) == 1 for entry in self.entries):
            return None
        entries = tuple(replace(entry, parts=entry.parts[1:]) for entry in self.entries)
        folders = frozenset(folder[1:] for folder in self.folders if len(folder) > 1)
        return Tree(name=tops.pop(), entries=entries, folders=folders, archive=self.archive)


def split_suffix(name: str) -> tuple[str, str]:
    """Split a file name into stem and suffix, the suffix in lower case.

    Examples
    --------
    >>> split_suffix("HW.1.IPYNB")
    ('HW.1', '.ipynb')
    >>> split_suffix("README")
    ('README', '')
    """
    stem, dot, suffix = name.rpartition(".")
    return (stem, f".{suffix.lower()}") if dot and stem else (name, "")


def is_noise(name: str) -> bool:
    """Say whether a file or folder of this name is left behind by a tool and never handed in.

    Examples
    --------
    >>> [is_noise(name) for name in (".ipynb_checkpoints", "__MACOSX", ".DS_Store", "alice.py")]
    [True, True, True, False]
    """
    return name.startswith(".") or name.casefold() in NOISE


def is_candidate(entry: Entry) -> bool:
    """Say whether the entry could be a submission, judged by its name alone."""
    return entry.suffix in SUBMISSION_SUFFIXES and entry.name.casefold() not in PROVIDED_FILES


def sort_key(parts: tuple[str, ...]) -> tuple[tuple[str, str], ...]:
    """Order paths without regard to case, then exactly: the same on every machine and in every locale."""
    return tuple((unicodedata.normalize("NFC", part).casefold(), part) for part in parts)
