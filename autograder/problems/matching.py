"""Which submission is whose: by its folder, its file name or the notebook's metadata, in that order."""

from __future__ import annotations

import re
import unicodedata
from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from autograder.problems.roster import Student, normal_id

__all__ = ["Match", "Upload", "match"]

_WORDS = re.compile(r"[^\W\d_]+")


@dataclass(frozen=True)
class Upload:
    """What is known of a submission before anybody reads it.

    Parameters
    ----------
    submission : str
        Its identifier in the run.
    path : str
        Where it was found, with / between folders.
    metadata : str
        What a notebook's metadata say: a student's id, or the identifier of a variant; "" where nothing.
    """

    submission: str
    path: str
    metadata: str = ""


@dataclass(frozen=True)
class Match:
    """Whose a submission is taken to be.

    Parameters
    ----------
    submission : str
        Its identifier in the run.
    student_id : str, optional
        None where nobody's.
    by : str
        "folder", "file name", "notebook metadata", or "" where nobody's.
    note : str
        What a human should know; "" where all is plain.
    """

    submission: str
    student_id: str | None
    by: str = ""
    note: str = ""


def match(
    uploads: Sequence[Upload], students: Iterable[Student], variants: Mapping[str, str] | None = None
) -> list[Match]:
    """Match submissions to students, in the order in which they came.

    An id counts where it stands by itself, not inside a longer word; of two ids, one inside the
    other, the longer counts. Where a folder or file name holds no id, an email address of the
    roster is taken instead, or a part between underscores that is the address up to its @ or a
    full name; only where one student alone has it.

    Parameters
    ----------
    uploads : sequence of Upload
        The submissions.
    students : iterable of Student
        The class.
    variants : mapping, optional
        Identifier of a variant -> student id.
    """
    known = _Names(students)
    owners = variants or {}
    found = [_match(upload, known, owners) for upload in uploads]
    count = Counter(item.student_id for item in found if item.student_id is not None)
    return [
        replace(item, note=_join(item.note, f"{item.student_id} has {count[item.student_id]} submissions"))
        if item.student_id is not None and count[item.student_id] > 1
        else item
        for item in found
    ]


def _match(upload: Upload, known: _Names, owners: Mapping[str, str]) -> Match:
    *folders, file = [part for part in upload.path.replace("\\", "/").split("/") if part not in {"", ".", ".."}] or [""]
    stem = file.rpartition(".")[0] or file
    places = [("folder", folder) for folder in reversed(folders)] + [("file name", stem)]
    stated = normal_id(upload.metadata)
    owner = known.id_of(stated) or known.id_of(owners.get(stated, ""))
    note = ""
    for by, text in places:
        names = known.names_in(text)
        if len(names) == 1:
            if owner not in {None, names[0]}:
                note = _join(note, f"the notebook metadata name {owner}")
            return Match(upload.submission, names[0], by, note)
        if names:
            note = _join(note, f"the {by} names {' and '.join(names)}")
    if owner is not None:
        return Match(upload.submission, owner, "notebook metadata", note)
    return Match(upload.submission, None, "", _join(note, "it names nobody of the roster"))


class _Names:
    """The ids, addresses and names of a class, to be found in text."""

    def __init__(self, students: Iterable[Student]) -> None:
        self._ids: dict[str, str] = {}
        addresses: defaultdict[str, set[str]] = defaultdict(set)
        parts: defaultdict[str, set[str]] = defaultdict(set)
        for student in students:
            self._ids[student.student_id.casefold()] = student.student_id
            address = student.email.casefold()
            if address:
                addresses[address].add(student.student_id)
                parts[address.partition("@")[0]].add(student.student_id)
            words = _WORDS.findall(_plain(student.name))
            if len(words) > 1:  # "Ann Lee" stands as ann lee, annlee or leeann, as the system likes it
                parts["".join(words)].add(student.student_id)
                parts["".join(words[-1:] + words[:-1])].add(student.student_id)
        self._addresses = _unique(addresses)
        self._parts = _unique(parts)

    def id_of(self, text: str) -> str | None:
        return self._ids.get(text.casefold())

    def names_in(self, text: str) -> list[str]:
        """List the students that a text names: by ids, else by addresses, else by a whole part that is a name."""
        text = unicodedata.normalize("NFC", text).casefold()
        for names in (self._ids, self._addresses):
            found = _longest(text, names)
            if found:
                return found
        parts = {form for part in text.split("_") for form in (part, "".join(_WORDS.findall(_plain(part))))}
        return sorted({self._parts[part] for part in parts if part in self._parts})


def _unique(names: Mapping[str, set[str]]) -> dict[str, str]:
    """Keep what belongs to one student only."""
    return {text: next(iter(ids)) for text, ids in names.items() if len(ids) == 1}


def _longest(text: str, names: Mapping[str, str]) -> list[str]:
    """Find names that stand by themselves in a text and inside no longer one."""
    starts = [k for k in range(len(text)) if text[k].isalnum() and (k == 0 or not text[k - 1].isalnum())]
    ends = [k + 1 for k in range(len(text)) if k + 1 == len(text) or text[k].isalnum() != text[k + 1].isalnum()]
    spans = [
        (start, end)
        for start in starts
        for end in ends
        if start < end and (end == len(text) or not (text[end - 1].isalnum() and text[end].isalnum()))
    ]
    hits = [(start, end) for start, end in spans if text[start:end] in names]
    kept = [
        (start, end)
        for start, end in hits
        if not any(a <= start and end <= b and (a, b) != (start, end) for a, b in hits)
    ]
    return sorted({names[text[start:end]] for start, end in kept})


def _plain(text: str) -> str:
    """Write a name without accents and capitals."""
    apart = unicodedata.normalize("NFKD", text.casefold())
    return "".join(char for char in apart if not unicodedata.combining(char))


def _join(*notes: str) -> str:
    return "; ".join(filter(None, notes))
