"""Which result belongs into which row of somebody else's table: by ids, never by a name alone."""

from __future__ import annotations

import re
import unicodedata
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from autograder.errors import UsageError
from autograder.verdicts import Result


@dataclass(frozen=True)
class Person:
    """One student of a foreign table.

    Parameters
    ----------
    line : int
        Where in the file the student stands.
    ids : tuple of str
        What the system calls the student: number, login, address; no display name.
    downloads : tuple of str
        How the system names the student's download, number included, as a submission is called.
    name : str
        For messages to staff.
    account : str
        The person in this system as an upload from there says it, such as "Canvas 101".
    """

    line: int
    ids: tuple[str, ...]
    downloads: tuple[str, ...] = ()
    name: str = ""
    account: str = ""


@dataclass(frozen=True)
class Pairs:
    """What was found: results by line, and results that belong to nobody."""

    by_line: Mapping[int, Result]
    strangers: tuple[Result, ...]


def pair(
    results: Iterable[Result], people: Sequence[Person], table: str, given: Mapping[str, str] | None = None
) -> Pairs:
    """Find the row of every result.

    A result from this very system belongs to the row of the number that the upload came with. Otherwise the
    row has the student's id, or the id is the result's name, or that is how the system named the student's
    download. Nothing else counts, and no other system's number does.

    Parameters
    ----------
    results : iterable of Result
        What was graded.
    people : sequence of Person
        The rows.
    table : str
        What messages call the file.
    given : mapping, optional
        Submission -> id, where a human has decided.

    Raises
    ------
    UsageError
        Where two rows or two results claim each other's place, nothing fits at all, or `given` names
        what does not exist.
    """
    results = list(results)
    chosen = _decided(results, given or {})
    by_id = _index((person, _fold(one)) for person in people for one in person.ids)
    by_download = _index((person, _spoken(one)) for person in people for one in person.downloads)
    by_account = _index((person, _fold(person.account)) for person in people)
    by_line: dict[int, Result] = {}
    strangers = []
    for result in results:
        decided = chosen.get(result.submission)
        stated = decided or _stated(result)
        found = by_account.get(_fold(result.account), ()) if decided is None else ()
        found = found or by_id.get(_fold(stated or result.submission), ())
        if not found and decided is None:
            found = by_download.get(_spoken(result.submission), ())
        if not found and decided is not None:
            raise UsageError(f"{table} has nobody with the id {stated!r}, which {result.submission} was given.")
        if len(found) > 1:
            lines = " and ".join(str(person.line) for person in found[:3])
            raise UsageError(
                f"{table}, lines {lines}: they have the same id {stated or result.submission!r}, so the mark of "
                f"{result.submission} could be anybody's; expected every id once."
            )
        if not found:
            strangers.append(result)
            continue
        line = found[0].line
        if line in by_line:
            raise UsageError(
                f"{by_line[line].submission} and {result.submission} both belong to line {line} of {table}; "
                "take the upload that does not count away, and grade again."
            )
        by_line[line] = result
    if results and not by_line:
        there = people[0].ids[0] if people and people[0].ids else "missing"
        raise UsageError(
            f"{table} fits none of the {len(results)} results (the first is {results[0].submission!r}, the first id "
            f"there is {there!r}); is it the file of this course? Where only the names differ, say who is who with "
            "--is SUBMISSION=ID."
        )
    return Pairs(by_line, tuple(strangers))


def remarks(pairs: Pairs, people: Sequence[Person], table: str) -> list[str]:
    """Say what was left alone, for the person at the keyboard."""
    notes = []
    if pairs.strangers:
        notes.append(f"Not in {table}: {listing([one.submission for one in pairs.strangers])}; left out.")
    without = [person for person in people if person.line not in pairs.by_line]
    if without:
        notes.append(f"Without a result: {listing([person.name for person in without])}; the cell stays as it was.")
    found = pairs.by_line.values()
    ours = [one.submission for one in found if one.score is None]
    if ours:
        notes.append(f"Could not be graded, our fault: {listing(ours)}; the cell stays as it was.")
    unread = [one.submission for one in found if one.status == "rejected" and not one.adjustments]
    if unread:
        notes.append(f"Could not be read, scored 0: {listing(unread)}; a human should look.")
    waiting = sum(one.provisional for one in found)
    if waiting:
        notes.append(f"Provisional: {waiting} marks still wait for a reader.")
    return notes


def listing(names: Sequence[str], limit: int = 8) -> str:
    """List names, the first few of them.

    Examples
    --------
    >>> listing(["ada"]), listing(["a", "b", "c"], limit=2)
    ('ada', 'a, b and 1 more')
    """
    from_them = ", ".join(" ".join(name.split()) for name in names[:limit])
    return f"{from_them} and {len(names) - limit} more" if len(names) > limit else from_them


def _decided(results: Sequence[Result], given: Mapping[str, str]) -> dict[str, str]:
    known = {result.submission for result in results}
    for name in given:
        if name not in known:
            raise UsageError(f"--is {name}=...: there is no such submission among the results; grades.csv lists them.")
    return dict(given)


def _stated(result: Result) -> str | None:
    """Return the id of a roster or an institution; what only the system of the upload knows is none."""
    of_its_system = result.account and not result.by
    return None if of_its_system else result.student_id


def _index(keys: Iterable[tuple[Person, str]]) -> dict[str, list[Person]]:
    found: defaultdict[str, list[Person]] = defaultdict(list)
    for person, key in keys:
        if key and person not in found[key]:
            found[key].append(person)
    return {key: people for key, people in found.items() if people}


def _fold(text: str) -> str:
    return unicodedata.normalize("NFKC", unicodedata.normalize("NFKC", text.strip()).casefold())


def _spoken(text: str) -> str:
    """Keep letters and digits only: a submission is called like the download, but for signs that file names lack."""
    return " ".join(re.findall(r"[^\W_]+", _fold(text)))
