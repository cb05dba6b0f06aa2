"""A plain folder: every file is a submission and is called by its stem."""

from __future__ import annotations

from collections import Counter

from autograder.intake.tree import Tree, is_candidate
from autograder.intake.upload import HOMEWORK, Upload, is_wrong_kind, wrong_kind_problem

TITLE = "plain folder of files"


def recognise(tree: Tree) -> float:
    """Claim every tree with a submission in it, weakly."""
    return 0.1 if any(is_candidate(entry) for entry in tree.entries) else 0.0


def gather(tree: Tree) -> list[Upload]:
    """Take every file that is a submission by its name; others are left alone."""
    uploads = []
    beside = Counter(entry.parts[:-1] for entry in tree.entries if is_candidate(entry))
    for entry in tree.entries:
        folder = entry.parts[-2] if len(entry.parts) > 1 else tree.name
        if is_candidate(entry):
            # the name under which the homework is handed out does not say whose it is
            name = folder if entry.stem.casefold() == HOMEWORK and beside[entry.parts[:-1]] == 1 else entry.stem
            uploads.append(Upload(name=name, entry=entry, folder=folder))
        elif is_wrong_kind(entry) or entry.closed_folder:
            problem = entry.problem or wrong_kind_problem(entry)
            uploads.append(Upload(name=entry.stem, entry=entry, problem=problem, folder=folder))
    return uploads
