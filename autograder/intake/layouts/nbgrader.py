"""nbgrader's course folder: submitted/<student>/<assignment>/<notebook>.ipynb, with a timestamp.txt beside it."""

from __future__ import annotations

from autograder.errors import RejectedUpload
from autograder.intake.naming import printable
from autograder.intake.tree import Entry, Tree, is_candidate, is_noise
from autograder.intake.upload import Upload, choose, strays
from autograder.owner import Owner

TITLE = "nbgrader submitted/ tree"
STEP = "submitted"
TIMESTAMP = "timestamp.txt"


def recognise(tree: Tree) -> float:
    """Claim trees with a folder `submitted`, folders of that name, and trees with time stamps in the right places."""
    folders = _by_assignment(tree)
    if not any(any(map(is_candidate, entries)) for entries in folders.values()):
        return 0.0
    if (STEP,) in tree.folders or tree.name == STEP:
        return 0.8
    stamped = sum(any(entry.name == TIMESTAMP for entry in entries) for entries in folders.values())
    return 0.8 if 2 * stamped >= len(folders) else 0.0


def gather(tree: Tree) -> list[Upload]:
    """Take one submission a student; where several assignments were collected, one a student and assignment."""
    folders = _by_assignment(tree)
    several = len({assignment for _, assignment in folders}) > 1
    uploads = []
    for (student, assignment), entries in folders.items():
        chosen, problem, notes = choose([entry for entry in entries if entry.name != TIMESTAMP])
        name = f"{student}-{assignment}" if several else student
        stamp = next((entry for entry in entries if entry.name == TIMESTAMP), None)
        owner = Owner("nbgrader", id=student)
        uploads.append(Upload(name, chosen, problem, f"{student}/{assignment}", notes, owner, submitted=_time(stamp)))
    shallow = 3 if (STEP,) in tree.folders else 2
    step = [entry for entry in tree.entries if shallow == 2 or entry.parts[0] == STEP]
    return uploads + strays((entry for entry in step if len(entry.parts) <= shallow), "nbgrader")


def _by_assignment(tree: Tree) -> dict[tuple[str, str], list[Entry]]:
    """Group the files by (student, assignment)."""
    skip = 1 if (STEP,) in tree.folders else 0
    paths = sorted(folder[skip:] for folder in tree.folders if not skip or folder[0] == STEP)
    found: dict[tuple[str, str], list[Entry]] = {
        (path[0], path[1]): [] for path in paths if len(path) == 2 and not any(map(is_noise, path))
    }
    for entry in tree.entries:
        parts = entry.parts[skip:]
        if len(parts) >= 3 and (not skip or entry.parts[0] == STEP):
            found.setdefault((parts[0], parts[1]), []).append(entry)
    return found


def _time(stamp: Entry | None) -> str:
    if stamp is None or stamp.problem:
        return ""
    try:
        return printable(stamp.load(200).decode("utf-8", "replace").strip())[:60]
    except RejectedUpload:
        return ""
