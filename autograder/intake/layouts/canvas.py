"""Canvas's submissions.zip: one flat folder of files named <name>[_LATE]_<user id>_<attachment id>_<file>."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

from autograder.intake.naming import printable
from autograder.intake.tree import Entry, Tree, is_candidate
from autograder.intake.upload import Upload, choose, listing, strays
from autograder.owner import Owner

TITLE = "Canvas submissions.zip"
SYSTEM = "Canvas"
TEST_STUDENT = "studenttest"  # whom Canvas gives teachers to try a course with

_NAME = r"(?:(?P<before>LATE_)?(?P<anonymous>anon_[^_]+)|(?P<name>.+?)(?P<after>_LATE)?_(?P<user>\d+))"
_FILE = re.compile(_NAME + r"_(?P<attachment>\d{1,18})_(?P<file>.+)", re.IGNORECASE | re.DOTALL)
_ENTRY = re.compile(_NAME + r"_(?P<kind>text|link)\.html", re.IGNORECASE | re.DOTALL)
_ATTEMPT = re.compile(r"-\d{1,3}$")  # Canvas appends -1, -2 .. to the name of a file that is handed in again


@dataclass(frozen=True)
class _Attachment:
    """One file of one student; `own` is the entry under the name that the student gave it."""

    entry: Entry
    own: Entry
    owner: Owner
    late: bool
    number: int  # attachment ids grow with time


def recognise(tree: Tree) -> float:
    """Claim folders where nearly every file at the top has a name of this pattern."""
    ours = sum(_is_ours(entry) for entry in tree.entries)
    foreign = sum(is_candidate(entry) and not _is_ours(entry) for entry in tree.entries)
    return 0.9 if ours >= 9 * foreign and ours else 0.0


def gather(tree: Tree) -> list[Upload]:
    """Take the file that counts of each student; text entries and links are reported where there is no file."""
    students: dict[str, list[_Attachment]] = {}
    others: dict[str, tuple[Entry, Owner]] = {}
    uploads: list[Upload] = []
    for entry in tree.entries:
        if found := _FILE.fullmatch(entry.name):
            own = replace(entry, parts=(found["file"],))
            late = bool(found["before"] or found["after"])
            attachment = _Attachment(entry, own, _owner(found), late, int(found["attachment"]))
            students.setdefault(_student(found), []).append(attachment)
        elif found := _ENTRY.fullmatch(entry.name):
            others[_student(found)] = (entry, _owner(found))
        else:
            uploads += strays([entry], SYSTEM)
    uploads += [_upload(student, attachments) for student, attachments in students.items()]
    for student, (entry, owner) in others.items():
        if student not in students:
            problem = "is a text or a link typed into Canvas, expected one .py, .ipynb or .zip file"
            uploads.append(Upload(name=student, entry=entry, problem=problem, owner=owner))
    return uploads


def _upload(student: str, attachments: list[_Attachment]) -> Upload:
    """Take what counts of a student: of files that are one and the same handed in again, only the newest."""
    newest: dict[str, _Attachment] = {}
    for one in sorted(attachments, key=lambda one: one.number):
        newest[_ATTEMPT.sub("", one.own.stem).casefold() + one.own.suffix] = one
    by_entry = {id(one.own): one for one in newest.values()}
    entry, problem, notes = choose([one.own for one in newest.values()])
    chosen = by_entry[id(entry)] if entry is not None else max(newest.values(), key=lambda one: one.number)
    again = [one.own.name for one in attachments if one not in newest.values()]
    if again and entry is not None:
        notes = (*notes, f"Graded {printable(entry.name)[:80]}, the newest; handed in before: {listing(again)}.")
    return Upload(
        student, chosen.entry if entry is not None else None, problem,
        folder=student, notes=notes, owner=chosen.owner, late=chosen.late, own_name=chosen.own.name,
    )  # fmt: skip


def _is_ours(entry: Entry) -> bool:
    return len(entry.parts) == 1 and bool(_FILE.fullmatch(entry.name) or _ENTRY.fullmatch(entry.name))


def _student(found: re.Match[str]) -> str:
    return found["anonymous"] or f"{found['name']}_{found['user']}"


def _owner(found: re.Match[str]) -> Owner:
    number = (found["anonymous"] or found["user"]).removeprefix("anon_")
    name = found["name"] or ""
    nobody = "it is Canvas's Test Student, who is nobody" if name.casefold() == TEST_STUDENT else ""
    return Owner(SYSTEM, name=name, number=number, nobody=nobody)
