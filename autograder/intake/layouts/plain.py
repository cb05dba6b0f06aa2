"""A plain folder: every file is a submission and is called by its stem."""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import replace

from autograder.intake.inside import problem_inside
from autograder.intake.tree import HANDED_OUT, Entry, Tree, is_candidate
from autograder.intake.upload import HOMEWORK, Upload, is_begun, listing

TITLE = "plain folder of files"


def recognise(tree: Tree) -> float:
    """Claim every tree with a submission in it, weakly."""
    return 0.1 if any(is_candidate(entry) for entry in tree.entries) else 0.0


def gather(tree: Tree) -> list[Upload]:
    """Take every file that is a submission by its name or by what is inside; what is neither is reported.

    What lies beside a file that has the homework's name goes with that one, as a figure does; so does what is neither
    and is called as the submission beside it: jane.html, printed of jane.ipynb. Of jane.py and jane.ipynb the one that
    was begun counts; where both were, both are there for a human.
    """
    uploads: list[Upload] = []
    beside = Counter(entry.parts[:-1] for entry in tree.entries if is_candidate(entry))
    of_one = {entry.parts[:-1] for entry in tree.entries if is_candidate(entry) and _is_homework(entry)}
    called: defaultdict[tuple[str, ...], list[Entry]] = defaultdict(list)
    for entry in filter(is_candidate, tree.entries):
        called[_called(entry)].append(entry)
    going_with = {key: _unbegun(entries) for key, entries in called.items()}
    for entry in tree.entries:
        place = entry.parts[:-1]
        folder = entry.parts[-2] if len(entry.parts) > 1 else tree.name
        if is_candidate(entry) and entry.name in going_with[_called(entry)]:
            continue
        if is_candidate(entry):
            # the name under which the homework is handed out does not say whose it is
            name = folder if _is_homework(entry) and beside[place] == 1 else entry.stem
            uploads.append(Upload(name=name, entry=entry, folder=folder))
        elif entry.closed_folder or (
            place not in of_one and (beside[place] or not place) and entry.name.casefold() not in HANDED_OUT
        ):
            problem = problem_inside(entry)
            if problem and _called(entry) in called and not entry.closed_folder:
                going_with[_called(entry)].append(entry.name)
            else:
                uploads.append(Upload(name=_called(entry)[-1], entry=entry, problem=problem, folder=folder))
    nothing = not any(is_candidate(entry) or entry.closed_folder for entry in tree.entries)
    if nothing and all(upload.problem for upload in uploads):
        return []
    return [_with(upload, going_with) for upload in uploads]


def _called(entry: Entry) -> tuple[str, ...]:
    """Return where a file lies and what its submission is called: ada of ada.py.txt."""
    return (*entry.parts[:-1], re.sub(r"\.(?:py|ipynb)$", "", entry.stem, flags=re.IGNORECASE))


def _unbegun(entries: Sequence[Entry]) -> list[str]:
    """Name those of one student's files that do not count, because one other alone was begun."""
    begun = [entry for entry in entries if is_begun(entry)] if len(entries) > 1 else []
    return [entry.name for entry in entries if entry not in begun] if len(begun) == 1 else []


def _with(upload: Upload, going_with: Mapping[tuple[str, ...], Sequence[str]]) -> Upload:
    """Say on a submission what was handed in beside it under its name, so that no file is dropped in silence."""
    entry = upload.entry
    names = going_with.get(_called(entry), ()) if entry is not None and is_candidate(entry) else ()
    if entry is None or not names:
        return upload
    return replace(upload, notes=(f"Graded {entry.name}; also handed in and not graded: {listing(names)}.",))


def _is_homework(entry: Entry) -> bool:
    return entry.stem.casefold() == HOMEWORK
