"""A plain folder: every file is a submission and is called by its stem."""

from __future__ import annotations

import re
from collections import Counter

from autograder.intake.inside import problem_inside
from autograder.intake.tree import HANDED_OUT, Entry, Tree, is_candidate
from autograder.intake.upload import HOMEWORK, Upload

TITLE = "plain folder of files"


def recognise(tree: Tree) -> float:
    """Claim every tree with a submission in it, weakly."""
    return 0.1 if any(is_candidate(entry) for entry in tree.entries) else 0.0


def gather(tree: Tree) -> list[Upload]:
    """Take every file that is a submission by its name or by what is inside; what is neither is reported.

    Only what lies beside a file that has the homework's name goes with that one, as a figure does.
    """
    uploads = []
    beside = Counter(entry.parts[:-1] for entry in tree.entries if is_candidate(entry))
    of_one = {entry.parts[:-1] for entry in tree.entries if is_candidate(entry) and _is_homework(entry)}
    for entry in tree.entries:
        place = entry.parts[:-1]
        folder = entry.parts[-2] if len(entry.parts) > 1 else tree.name
        if is_candidate(entry):
            # the name under which the homework is handed out does not say whose it is
            name = folder if _is_homework(entry) and beside[place] == 1 else entry.stem
            uploads.append(Upload(name=name, entry=entry, folder=folder))
        elif entry.closed_folder or (
            place not in of_one and (beside[place] or not place) and entry.name.casefold() not in HANDED_OUT
        ):
            name = re.sub(r"\.(?:py|ipynb)$", "", entry.stem, flags=re.IGNORECASE)  # of ada.py.txt
            uploads.append(Upload(name=name, entry=entry, problem=problem_inside(entry), folder=folder))
    nothing = not any(is_candidate(entry) or entry.closed_folder for entry in tree.entries)
    return [] if nothing and all(upload.problem for upload in uploads) else uploads


def _is_homework(entry: Entry) -> bool:
    return entry.stem.casefold() == HOMEWORK
