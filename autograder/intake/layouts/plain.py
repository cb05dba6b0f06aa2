"""A plain folder: every file is a submission and is called by its stem."""

from __future__ import annotations

from autograder.intake.tree import Entry, Tree, is_candidate
from autograder.intake.upload import HOMEWORK, Upload, is_wrong_kind, wrong_kind_problem

TITLE = "plain folder of files"


def recognise(tree: Tree) -> float:
    """Claim every tree with a submission in it, weakly."""
    return 0.1 if any(is_candidate(entry) for entry in tree.entries) else 0.0


def gather(tree: Tree) -> list[Upload]:
    """Take every file that is a submission by its name; others are left alone."""
    uploads = []
    for entry in tree.entries:
        folder = entry.parts[-2] if len(entry.parts) > 1 else tree.name
        if is_candidate(entry):
            # the name under which the homework is handed out does not say whose it is
            name = folder if entry.stem.casefold() == HOMEWORK and _is_alone(entry, tree) else entry.stem
            uploads.append(Upload(name=name, entry=entry, folder=folder))
        elif is_wrong_kind(entry) or (entry.problem and not entry.suffix):
            problem = entry.problem or wrong_kind_problem(entry)
            uploads.append(Upload(name=entry.stem, entry=entry, problem=problem, folder=folder))
    return uploads


def _is_alone(entry: Entry, tree: Tree) -> bool:
    beside = [other for other in tree.entries if other.parts[:-1] == entry.parts[:-1] and is_candidate(other)]
    return len(beside) == 1
