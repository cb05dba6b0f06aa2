"""A repository a student, as GitHub Classroom cloned them: <assignment>-<user>/ with a .git in each."""

from __future__ import annotations

import os
from collections.abc import Sequence

from autograder.intake.layouts.folder_a_student import by_folder
from autograder.intake.tree import Entry, Tree, is_candidate
from autograder.intake.upload import Upload, choose, strays
from autograder.owner import Owner

TITLE = "a repository a student"

_MARKS = (".git", ".github")
_BESIDE = frozenset({"test", "tests", "docs", "examples", "solution", "build", "dist"})


def recognise(tree: Tree) -> float:
    """Claim trees where most folders with a submission are repositories."""
    if any(len(entry.parts) == 1 and is_candidate(entry) for entry in tree.entries):
        return 0.0
    tops = [top for top, entries in by_folder(tree).items() if any(map(is_candidate, entries))]
    marked = sum(any((top, mark) in tree.folders for mark in _MARKS) for top in tops)
    if not marked or 2 * marked < len(tops):
        return 0.0
    return 0.7 if len(tops) > 1 else 0.4  # one repository in an archive is one student's


def gather(tree: Tree) -> list[Upload]:
    """Take one submission from every repository, called by what its folder's name does not share with the others."""
    folders = by_folder(tree)
    uploads = []
    for (top, entries), user in zip(folders.items(), users(list(folders)), strict=True):
        chosen, problem, notes = choose(_own_work(entries))
        uploads.append(Upload(user, chosen, problem, folder=top, notes=notes, owner=Owner("GitHub", id=user)))
    return uploads + strays((entry for entry in tree.entries if len(entry.parts) == 1), "GitHub")


def users(folders: Sequence[str]) -> list[str]:
    """Cut what all folders' names have in common before a dash.

    Examples
    --------
    >>> users(["slam-1d-ada", "slam-1d-alan"]), users(["ada", "alan"]), users(["slam-ada"])
    (['ada', 'alan'], ['ada', 'alan'], ['slam-ada'])
    """
    shared = os.path.commonprefix(list(folders)).rpartition("-") if len(folders) > 1 else ("", "", "")
    cut = len(shared[0] + shared[1])
    return [folder[cut:] for folder in folders] if all(len(folder) > cut for folder in folders) else list(folders)


def _own_work(entries: Sequence[Entry]) -> list[Entry]:
    """Leave out folders of tests and the like, unless nothing is left."""
    own = [entry for entry in entries if not _BESIDE & {part.casefold() for part in entry.parts[1:-1]}]
    return own if any(map(is_candidate, own)) else list(entries)
