"""Which submission is whose: the platform is believed; what a student wrote counts only where no platform speaks."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from autograder.owner import Owner
from autograder.problems.naming import Names
from autograder.problems.roster import Student, normal_id

__all__ = ["Match", "Upload", "match"]

STAFF = "word of the course staff"
# `slam1d-1`, `slam1d (2)`: a copy's number, put there by Canvas or a browser, is nobody's id
_COPY = re.compile(r"-([1-9]\d?)$|\s?\(([1-9]\d?)\)$")
_SHORT = 3  # an id of fewer signs stands in a file's name by chance
_LISTED = 4  # names in a sentence


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
    owner : Owner, optional
        What the layout says; None where it knows nothing.
    file : str
        The name that the student gave the file; "" where it is the last part of the path.
    """

    submission: str
    path: str
    metadata: str = ""
    owner: Owner | None = None
    file: str = ""


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
        "id in Gradescope", "name in Canvas", "folder", "file name" and the like; "" where nobody's.
    note : str
        What a human should know; "" where all is plain.
    """

    submission: str
    student_id: str | None
    by: str = ""
    note: str = ""


def match(
    uploads: Sequence[Upload],
    students: Iterable[Student],
    variants: Mapping[str, str] | None = None,
    given: Mapping[str, str] | None = None,
) -> list[Match]:
    """Match submissions to students, in the order in which they came.

    What staff have decided comes first, then what a platform says: its id, its address, the number that a
    column of the roster has for it, its name. Where a platform speaks, nothing that the student wrote is asked;
    where it contradicts, that is a note. Where none speaks, the folder, the file's name and the notebook's
    metadata count, in this order: an id that stands by itself, not inside a longer word (of two, one inside the
    other, the longer), else an address, else a part between underscores that is the address up to its @ or a
    full name; only where one student alone has it.

    Parameters
    ----------
    uploads : sequence of Upload
        The submissions.
    students : iterable of Student
        The class.
    variants : mapping, optional
        Identifier of a variant -> student id.
    given : mapping, optional
        Submission -> student id, where staff have decided.
    """
    names = Names(students)
    owners = [upload.owner for upload in uploads if upload.owner is not None and upload.owner.number]
    partly = {owner.system for owner in owners if names.id_of(owner.number) is None}
    matcher = _Matcher(names, variants or {}, given or {}, partly)
    found = [matcher.of(upload) for upload in uploads]
    of_one: defaultdict[str, list[str]] = defaultdict(list)
    for item in found:
        if item.student_id is not None:
            of_one[item.student_id].append(item.submission)
    return [
        replace(item, note=_join(item.note, _several(item.student_id, of_one[item.student_id])))
        if item.student_id is not None and len(of_one[item.student_id]) > 1
        else item
        for item in found
    ]


def _several(student: str, names: Sequence[str]) -> str:
    shown = ", ".join(names[:_LISTED]) + (", ..." if len(names) > _LISTED else "")
    return f"{student} has {len(names)} submissions ({shown}): take away what does not count, and grade again"


@dataclass(frozen=True)
class _Matcher:
    names: Names
    variants: Mapping[str, str]
    given: Mapping[str, str]
    partly: Collection[str]  # systems of which not every number is an id of the roster

    def of(self, upload: Upload) -> Match:
        """Say whose an upload is, and what contradicts."""
        owner = upload.owner or Owner()
        notes: list[str] = []
        if upload.submission in self.given:
            found, by = self.given[upload.submission], STAFF
        elif owner.system:
            found, by, notes = self._spoken(owner)
        else:
            return self._silent(upload, owner.place)
        wrote = {"the notebook metadata name": self._metadata(upload), "the file name names": self._file(upload)}
        notes += [f"{words} {other}" for words, other in wrote.items() if other not in {None, found}]
        return Match(upload.submission, found or None, by if found else "", _join(*notes))

    def _spoken(self, owner: Owner) -> tuple[str, str, list[str]]:
        """Ask what the platform says: (student or "", by, notes)."""
        if owner.nobody:
            return "", "", [owner.nobody]
        asked = {
            f"id in {owner.system}": self.names.known_as(owner.id),
            f"address in {owner.system}": self.names.known_as(owner.email),
            f"number in {owner.system}": self.names.of_account(owner.system, owner.number),
        }
        said = {by: one for by, one in asked.items() if one is not None}
        people = self.names.named(owner.name)
        numbered = self.names.id_of(owner.number) or ""
        if len(people) == 1:
            said[f"name in {owner.system}"] = people[0]
        elif numbered in people or (not people and self._by_number(owner.system, numbered)):
            said[f"number in {owner.system}"] = numbered
        if not said:
            shared = (
                f", a name that {' and '.join(people)} share" if len(people) > 1 else ", names nobody of the roster"
            )
            return "", "", [f"{owner}{shared}; say whose it is with --is"]
        by, found = next(iter(said.items()))
        return found, by, [f"the {other} is that of {one}" for other, one in said.items() if one != found]

    def _by_number(self, system: str, numbered: str) -> bool:
        """Say whether a roster without names is one of this system's numbers: it knows all that have come."""
        return bool(numbered) and system not in self.partly and self.names.has_no_name(numbered)

    def _silent(self, upload: Upload, place: str) -> Match:
        """Read what stands in the folder's and the file's name, and in a notebook, where no platform speaks."""
        *folders, _ = ["", *_parts(upload.path)]
        inner_last = [place, *folders[2:], *folders[1:2]]  # the outermost folder may hold the whole class
        claims = {("folder", "names"): [self.names.in_text(folder) for folder in filter(None, inner_last)]}
        claims["file name", "names"] = [self._in_file(upload)]
        stated = self._metadata(upload)
        claims["notebook metadata", "name"] = [[stated]] if stated else []
        found, by, notes = None, "", []
        for (where, verb), texts in claims.items():
            for names in texts:
                if len(names) == 1 and found is None:
                    found, by = names[0], where
                elif names and names != [found] and not (where == "file name" and found and _by_chance(names)):
                    notes.append(f"the {where} {verb} {' and '.join(names)}")
        if found is None:
            notes.append("it names nobody of the roster")
        return Match(upload.submission, found, by, _join(*dict.fromkeys(notes)))

    def _metadata(self, upload: Upload) -> str | None:
        stated = normal_id(upload.metadata)
        return self.names.id_of(stated) or self.names.id_of(self.variants.get(stated, ""))

    def _file(self, upload: Upload) -> str | None:
        """Return whom the file's name names plainly, where that is one student."""
        names = self._in_file(upload)
        return names[0] if len(names) == 1 and not _by_chance(names) else None

    def _in_file(self, upload: Upload) -> list[str]:
        file = upload.file or (_parts(upload.path) or [""])[-1]
        stem = file.rpartition(".")[0] or file
        names = self.names.in_text(stem)
        copy = _COPY.search(stem)
        return self.names.in_text(stem[: copy.start()]) if copy and {copy[1], copy[2]} & set(names) else names


def _by_chance(names: Sequence[str]) -> bool:
    return all(len(name) < _SHORT for name in names)


def _parts(path: str) -> list[str]:
    return [part for part in path.replace("\\", "/").split("/") if part not in {"", ".", ".."}]


def _join(*notes: str) -> str:
    return "; ".join(filter(None, notes))
