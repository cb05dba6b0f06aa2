"""A folder a student: every folder at the top holds one submission, which is called by the folder's name."""

from __future__ import annotations

from itertools import groupby

from autograder.intake.inside import problem_inside
from autograder.intake.layouts import GENERIC
from autograder.intake.tree import HANDED_OUT, Entry, Tree, is_candidate, is_noise
from autograder.intake.upload import Upload, choose, stands_alone
from autograder.owner import Owner

TITLE = "a folder a student"


def recognise(tree: Tree) -> float:
    """Claim trees whose submissions lie alone in their folders; beside files at the top, only where all do."""
    found = [stands_alone(entries) for entries in by_folder(tree).values() if any(map(is_candidate, entries))]
    alone = sum(found)
    if _at_top(tree):
        return 0.2 if found and alone == len(found) else 0.0
    return GENERIC if found and 2 * alone >= len(found) else 0.0


def gather(tree: Tree) -> list[Upload]:
    """Take one submission from every folder at the top, and files at the top by their stem.

    A folder without a submission is reported, not skipped, unless students hand in files.
    """
    at_top = _at_top(tree)
    uploads = [Upload(name=entry.stem, entry=entry, folder=tree.name) for entry in at_top]
    if at_top:
        uploads += [Upload(entry.stem, entry, problem_inside(entry), tree.name) for entry in _foreign(tree)]
    for student, entries in by_folder(tree).items():
        entry, problem, notes = choose(entries)
        if len(entries) == 1 and len(entries[0].parts) == 1:
            problem = entries[0].problem  # the folder itself is a link or cannot be listed
        elif at_top and not any(map(is_candidate, entries)):
            continue
        uploads.append(
            Upload(name=student, entry=entry, problem=problem, folder=student, notes=notes, owner=Owner(place=student))
        )
    return uploads


def _at_top(tree: Tree) -> list[Entry]:
    return [entry for entry in tree.entries if len(entry.parts) == 1 and is_candidate(entry)]


def _foreign(tree: Tree) -> list[Entry]:
    """Find the other files at the top; what is inside says whether they are read."""
    return [
        entry
        for entry in tree.entries
        if len(entry.parts) == 1
        and not (is_candidate(entry) or entry.problem or entry.closed_folder)
        and entry.name.casefold() not in HANDED_OUT
    ]


def by_folder(tree: Tree) -> dict[str, list[Entry]]:
    """Group the files of a tree by their folder at the top; empty folders are listed too."""
    tops = {folder[0]: list[Entry]() for folder in sorted(tree.folders) if not is_noise(folder[0])}
    below = [
        entry
        for entry in tree.entries
        if len(entry.parts) > 1 or entry.closed_folder or (entry.problem and not entry.suffix)
    ]
    for top, entries in groupby(below, key=lambda entry: entry.parts[0]):
        tops.setdefault(top, []).extend(entries)
    return tops
