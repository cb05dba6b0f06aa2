"""Moodle's download of an assignment: <full name>_<id>_assignsubmission_file_, as folders or as one flat folder."""

from __future__ import annotations

import re
from dataclasses import replace

from autograder.intake.tree import Entry, Tree
from autograder.intake.upload import Upload, choose, strays
from autograder.owner import Owner

TITLE = "Moodle assignment folders"

# the first mark is Moodle's; a later one stands in the name that the student gave the file
_OWNER = re.compile(r"(?P<name>.+?)_(?P<id>\d+)_assignsubmission_(?P<kind>file|onlinetext)_?(?P<file>.*)", re.DOTALL)


def recognise(tree: Tree) -> float:
    """Claim trees where most of what stands at the top is named like this."""
    tops = {entry.parts[0] for entry in tree.entries} | {folder[0] for folder in tree.folders}
    ours = sum(_OWNER.fullmatch(top) is not None for top in tops)
    return 0.9 if ours and 2 * ours >= len(tops) else 0.0


def gather(tree: Tree) -> list[Upload]:
    """Take one submission a participant; the id joins it with the grading worksheet."""
    participants: dict[tuple[str, str], list[Entry]] = {}
    for top in sorted({folder[0] for folder in tree.folders}):
        if found := _OWNER.fullmatch(top):
            participants.setdefault((found["name"], found["id"]), [])
    for entry in tree.entries:
        if found := _OWNER.fullmatch(entry.parts[0]):
            flat = len(entry.parts) == 1 and found["file"]
            own = replace(entry, parts=(found["file"],)) if flat else entry
            participants.setdefault((found["name"], found["id"]), []).append(own)
    uploads = []
    for (name, number), entries in participants.items():
        chosen, problem, notes = choose(entries)
        shown = f"{name}_{number}"
        owner = Owner("Moodle", name=name, number=number)
        uploads.append(Upload(shown, chosen, problem, folder=shown, notes=notes, owner=owner))
    return uploads + strays((entry for entry in tree.entries if not _OWNER.fullmatch(entry.parts[0])), "Moodle")
