"""Gradescope's export of submissions: folders submission_<id>, and submission_metadata.yml that says whose they are."""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace

from autograder.errors import RejectedUpload
from autograder.intake.layouts.folder_a_student import by_folder
from autograder.intake.naming import printable
from autograder.intake.tree import Entry, Tree
from autograder.intake.upload import Upload, choose, strays
from autograder.owner import Owner

TITLE = "Gradescope export with submission_metadata.yml"
SYSTEM = "Gradescope"
METADATA = "submission_metadata.yml"
MAX_METADATA = 32 << 20  # bytes; it repeats the results of every attempt

_FOLDER = re.compile(r"submission_\d+")
_KEY = re.compile(r"(?P<indent> *)(?P<item>- )?:?(?P<key>[\w .\-]+|'[^']*'|\"[^\"]*\"):(?: (?P<value>.*))?")


@dataclass
class Record:
    """What the metadata say about one folder."""

    submitters: list[dict[str, str]] = field(default_factory=list)
    created_at: str = ""
    earlier: int = 0


def recognise(tree: Tree) -> float:
    """Claim trees with the metadata file at the top, or whose folders are all called submission_<number>."""
    if any(entry.parts == (METADATA,) for entry in tree.entries):
        return 0.95
    tops = list(by_folder(tree))
    return 0.6 if tops and all(_FOLDER.fullmatch(top) for top in tops) else 0.0


def gather(tree: Tree) -> list[Upload]:
    """Take one submission a student: every member of a group has the group's."""
    records, trouble = _records(tree)
    folders: dict[str, list[Entry]] = {
        name: entries for name, entries in by_folder(tree).items() if name in records or _FOLDER.fullmatch(name)
    }
    newest: dict[str, Upload] = {}
    for name in sorted(folders.keys() | records.keys()):
        record = records.get(name, Record())
        entry, problem, notes = choose(folders.get(name, ()))
        if name not in folders:
            problem = f"is listed in {METADATA}, but its folder is not there; export the submissions again"
        notes = (*notes, *trouble, *_remarks(record))
        for student, owner in _students(record, name):
            upload = Upload(student, entry, problem, name, notes, owner, submitted=record.created_at)
            before = newest.get(student)
            if before is not None:
                older, upload = sorted((before, upload), key=lambda each: each.submitted)
                words = f"Graded {upload.folder}, the newest; also handed in: {older.folder}."
                upload = replace(upload, notes=(*upload.notes, words))
            newest[student] = upload
    return [*newest.values(), *strays((entry for entry in tree.entries if entry.parts[0] not in folders), SYSTEM)]


def _records(tree: Tree) -> tuple[dict[str, Record], tuple[str, ...]]:
    """Read the metadata file: records by folder, and a remark where it cannot be read."""
    for entry in tree.entries:
        if entry.parts == (METADATA,):
            try:
                if entry.problem:
                    raise RejectedUpload(entry.problem)
                data = entry.load(MAX_METADATA)
                if len(data) > MAX_METADATA:
                    raise RejectedUpload("is larger than 32 MiB")
                return read_metadata(data.decode("utf-8-sig")), ()
            except RejectedUpload as error:
                return {}, (f"{METADATA} {error}; submissions are called by their folders.",)
            except UnicodeDecodeError:
                return {}, (f"{METADATA} is not UTF-8; submissions are called by their folders.",)
    return {}, (f"There is no {METADATA}; submissions are called by their folders.",)


def read_metadata(text: str) -> dict[str, Record]:
    """Read the few fields that count out of the metadata, by their indentation; all else is skipped.

    The file is YAML as Ruby writes it: a folder's name at the margin, its fields two blanks in, keys with a colon
    in front, and what is longer (results, earlier attempts) indented further.

    Examples
    --------
    >>> records = read_metadata('''---
    ... submission_7:
    ...   :submitters:
    ...   - :name: Zoë
    ...     :sid: '042'
    ...   :created_at: 2026-01-02 03:04:05 Z
    ... ''')
    >>> records["submission_7"].submitters, records["submission_7"].created_at
    ([{'name': 'Zoë', 'sid': '042'}], '2026-01-02 03:04:05 Z')
    """
    records: dict[str, Record] = {}
    record, section, items = Record(), "", 0  # items: how far the list of this section is indented
    for line in text.splitlines():
        found = _KEY.fullmatch(line.rstrip())
        if found is None:
            continue
        indent, key, value = len(found["indent"]), _scalar(found["key"]), _scalar(found["value"] or "")
        if indent == 0 and not found["item"]:
            record, section = records.setdefault(key, Record()), ""
        elif indent == 2 and not found["item"]:
            section, items = key, 0
            if key == "created_at":
                record.created_at = value[:40]
        elif found["item"] and items in (0, indent):
            items = indent
            record.earlier += section == "history"
            if section == "submitters":
                record.submitters.append({key: value})
        elif section == "submitters" and record.submitters and indent == items + 2:
            record.submitters[-1][key] = value
    return records


def _students(record: Record, folder: str) -> list[tuple[str, Owner]]:
    """Return every member with a name for the submission; the folder's where the metadata name nobody."""
    found: list[tuple[str, Owner]] = []
    for person in record.submitters:
        owner = Owner(SYSTEM, *(person.get(key, "") for key in ("sid", "email", "name")))
        name = "_".join(filter(None, (owner.name, owner.best)))
        if name:
            found.append((name, owner))
    return list(dict.fromkeys(found)) or [(folder, Owner(SYSTEM))]


def _remarks(record: Record) -> tuple[str, ...]:
    notes = []
    if len(record.submitters) > 1:
        notes.append(f"Handed in by a group of {len(record.submitters)}; it counts for every member.")
    if record.earlier:
        notes.append(f"The newest of {record.earlier + 1} attempts.")
    return tuple(notes)


def _scalar(text: str) -> str:
    """Return a YAML scalar without its quotes."""
    text = text.strip()
    if len(text) >= 2 and text[0] == text[-1] == "'":
        text = text[1:-1].replace("''", "'")
    elif len(text) >= 2 and text[0] == text[-1] == '"':
        text = re.sub(r"\\(?:x(\w\w)|u(\w{4})|(.))", _unescape, text[1:-1])
    return printable("" if text in ("null", "~") else text)


def _unescape(found: re.Match[str]) -> str:
    code = found[1] or found[2]
    try:
        return chr(int(code, 16)) if code else found[3]
    except ValueError:
        return found[0]
