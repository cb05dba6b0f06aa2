"""A folder a student: every folder at the top holds one submission, which is called by the folder's name."""

from __future__ import annotations

from itertools import groupby

from autograder.intake.layouts import GENERIC
from autograder.intake.tree import Entry, Tree, is_candidate, is_noise
from autograder.intake.upload import Upload, choose

TITLE = "a folder a student"


def recognise(tree: Tree) -> float:
    """Claim trees whose submissions all lie in folders, most of them alone in theirs."""
    if any(len(entry.parts) == 1 and is_candidate(entry) for entry in tree.entries):
        return 0.0
    found = [choose(entries) for entries in by_folder(tree).values() if any(map(is_candidate, entries))]
    alone = sum(entry is not None for entry, _, _ in found)
    return GENERIC if found and 2 * alone >= len(found) else 0.0


def gather(tree: Tree) -> list[Upload]:
    """Take one submission from every folder at the top; a folder without one is reported, not skipped."""
    uploads = []
    for student, entries in by_folder(tree).items():
        entry, problem, notes = choose(entries)
        if len(entries) == 1 and len(entries[0].parts) == 1:
            problem = entries[0].problem  # the folder itself is a link or cannot be listed
        uploads.append(Upload(name=student, entry=entry, problem=problem, folder=student, notes=notes))
    return uploads


def by_folder(tree: Tree) -> dict[str, list[Entry]]:
    """Group the files of a tree by their folder at the top; empty folders are listed too."""
    tops = {folder[0]: list[Entry]() for folder in sorted(tree.folders) if not is_noise(folder[0])}
    below = [entry for entry in tree.entries if len(entry.parts) > 1 or (entry.problem and not entry.suffix)]
    for top, entries in groupby(below, key=lambda entry: entry.parts[0]):
        tops.setdefault(top, []).extend(entries)
    return tops
