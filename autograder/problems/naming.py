"""What the students of a class are called: ids, addresses, logins and names, to be found exactly or in a text."""

from __future__ import annotations

import re
import unicodedata
from collections import defaultdict
from collections.abc import Iterable, Mapping

from autograder.problems.roster import Student, normal_id

__all__ = ["Names"]

_WORDS = re.compile(r"[^\W_]+")
_ADDRESS = re.compile(r"([^@\s]+)@[^@\s]+")


class Names:
    """The ids, addresses and names of a class.

    Parameters
    ----------
    students : iterable of Student
        The class.
    """

    def __init__(self, students: Iterable[Student]) -> None:
        self._students = list(students)
        self._ids = {student.student_id.casefold(): student.student_id for student in self._students}
        addresses: defaultdict[str, set[str]] = defaultdict(set)
        logins: defaultdict[str, set[str]] = defaultdict(set)
        self._named: defaultdict[str, set[str]] = defaultdict(set)
        parts: defaultdict[str, set[str]] = defaultdict(set)
        self._nameless = set()
        for student in self._students:
            address = _ADDRESS.fullmatch(student.email.casefold())
            if address:
                addresses[address[0]].add(student.student_id)
                logins[address[1]].add(student.student_id)
            forms = _forms(student.name)
            for form in forms:
                self._named[form].add(student.student_id)
            if not forms:
                self._nameless.add(student.student_id)
            words = _words(student.name)
            if len(words) > 1:  # "Ann Lee" stands as ann lee, annlee or leeann, as the system likes it
                parts["".join(words)].add(student.student_id)
                parts["".join(words[-1:] + words[:-1])].add(student.student_id)
        self._addresses = _unique(addresses)
        self._logins = _unique(logins)
        self._parts = _unique(parts) | self._logins

    def id_of(self, text: str) -> str | None:
        """Return the student with exactly this id."""
        return self._ids.get(normal_id(text).casefold())

    def known_as(self, text: str) -> str | None:
        """Return the student with exactly this id, this address, or this part of an address before its @."""
        key = normal_id(text).casefold()
        return self._ids.get(key) or self._addresses.get(key) or self._logins.get(key)

    def of_account(self, system: str, number: str) -> str | None:
        """Return the one student for whom a column of the roster, headed by the system's name, has this number."""
        found = {
            student.student_id
            for student in self._students
            for heading, cell in student.others.items()
            if number and cell.casefold() == number.casefold() and heading.casefold().startswith(system.casefold())
        }
        return found.pop() if len(found) == 1 else None

    def named(self, name: str) -> list[str]:
        """List the students with this whole name, whatever the order of its parts, accents and signs.

        In front of a dash may stand the group, as Moodle writes it.
        """
        while True:
            found = {one for form in _forms(name) for one in self._named.get(form, ())}
            _, dash, rest = name.partition("-")
            if found or not dash:
                return sorted(found)
            name = rest

    def has_no_name(self, student_id: str) -> bool:
        """Say whether the roster has no name for this student."""
        return student_id in self._nameless

    def in_text(self, text: str) -> list[str]:
        """List the students that a text names: by ids, else by addresses, else by a whole part that is a name."""
        text = unicodedata.normalize("NFC", text).casefold()
        for names in (self._ids, self._addresses):
            found = _longest(text, names)
            if found:
                return found
        parts = {form for part in text.split("_") for form in (part, "".join(_words(part)))}
        return sorted({self._parts[part] for part in parts if part in self._parts})


def _words(name: str) -> list[str]:
    """Split a name into words without accents, signs and capitals."""
    apart = unicodedata.normalize("NFKD", name.casefold())
    return _WORDS.findall("".join(char for char in apart if not unicodedata.combining(char)))


def _forms(name: str) -> set[str]:
    """Write a name as systems do: words joined, any of them first, with and without letters that ASCII lacks.

    Examples
    --------
    >>> sorted(_forms("Zoë Lu")), sorted(_forms("O'Neil"))
    (['luzo', 'luzoe', 'zoelu', 'zolu'], ['neilo', 'oneil'])
    """
    bare = unicodedata.normalize("NFC", name).casefold()
    found = set()
    for words in (_words(name), _WORDS.findall("".join(char for char in bare if char.isascii()))):
        found |= {"".join(words[k:] + words[:k]) for k in range(len(words))}
    return found - {""}


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
