"""One upload: whose file it is, and which file counts where there are several."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from autograder.errors import RejectedUpload
from autograder.intake.inside import is_read
from autograder.intake.naming import printable
from autograder.intake.tree import EXPECTED, PROVIDED_FILES, Entry, is_candidate
from autograder.owner import Owner

HOMEWORK = "slam1d"  # the name under which the homework is handed out
CORE = {b"residual", b"jacobian", b"information_matrix", b"normal_equations", b"gauss_newton_step"}
_OPEN = re.compile(rb"\b(\w{1,40}) is not finished yet: replace this line")  # what a stub raises, as handed out
_DEFINED = re.compile(rb"(?:\\n|\b)def[ \t]+(\w{1,40})[ \t]*\(")
_EXPLORE, _OF_EXPLORE = "explore", {b"residual", b"jacobian"}  # the notebook to play with defines these itself
_LARGEST = 4 << 20  # bytes of a file that are looked at; one that is larger counts as begun
_MOST = 8  # files that are looked into, so that no archive takes long
_COMPANIONS = re.compile(r"(__init__|conftest|setup|noxfile|test_.*|.*_test)\.py", re.IGNORECASE)


@dataclass(frozen=True)
class Upload:
    """What one student (or group) handed in, before it is read.

    Parameters
    ----------
    name : str
        What the submission is to be called: the student's name where the layout has one, else the file's stem.
    entry : Entry or None
        The file that counts, None where there is none.
    problem : str
        Why there is no file to read, as the end of a sentence; "" where there is one.
    folder : str
        The folder it came from; tells two submissions of the same name apart.
    notes : tuple of str
        What staff should know about the choice; no note names another student.
    owner : Owner or None
        Who handed it in, where the layout says it.
    late : bool or None
        Whether the system marked it late; None where the layout does not say.
    submitted : str
        When it was handed in, as the layout has it; "" where it does not say.
    own_name : str
        The name that the student gave the file, where the layout has put something before it.
    """

    name: str
    entry: Entry | None
    problem: str = ""
    folder: str = ""
    notes: tuple[str, ...] = ()
    owner: Owner | None = None
    late: bool | None = None
    submitted: str = ""
    own_name: str = ""


def choose(entries: Sequence[Entry]) -> tuple[Entry | None, str, tuple[str, ...]]:
    """Pick the one file that counts among those of one attempt: (entry, problem, notes).

    What was begun counts: a file that defines a function of the homework, and not only as it was handed out. Two that
    were begun are for a human; where none was, the one that has the name of the homework is taken.
    """
    candidates = [entry for entry in entries if is_candidate(entry)] or [e for e in entries[:_MOST] if is_read(e)]
    if len(candidates) > 1:
        candidates = without_companions(candidates)
    if len(candidates) == 1:
        return candidates[0], "", ()
    named = [entry for entry in candidates if entry.stem.casefold() == HOMEWORK]
    begun = [entry for entry in (named if len(candidates) > _MOST else candidates)[:_MOST] if is_begun(entry)]
    chosen = begun or [entry for entry in named if not _is_untouched(entry)] or named[:1]
    if len(chosen) == 1:
        others = listing([entry.name for entry in candidates if entry is not chosen[0]])
        return chosen[0], "", (f"Graded {chosen[0].name}; also handed in and not graded: {others}.",)
    if candidates:
        names = listing([entry.name for entry in begun or candidates])
        return None, f"holds {len(begun or candidates)} submissions ({names}), {EXPECTED}; keep the one that counts", ()
    found = [entry.name for entry in entries]
    if any(name.casefold() in PROVIDED_FILES for name in found):
        return None, f"holds only files that were handed out ({listing(found)}), {EXPECTED}", ()
    return None, f"holds no submission (found {listing(found) or 'nothing'}), {EXPECTED}", ()


def stands_alone(entries: Sequence[Entry]) -> bool:
    """Say whether one student's work lies here, by the names alone: one file, or one that has the homework's name."""
    candidates = without_companions([entry for entry in entries if is_candidate(entry)])
    return len(candidates) == 1 or any(entry.stem.casefold() == HOMEWORK for entry in candidates)


def is_begun(entry: Entry) -> bool:
    """Say whether a file defines a function of the homework other than as it was handed out; where in doubt, yes."""
    if entry.suffix == ".zip" or entry.problem:
        return True
    defined, unfinished = _functions(entry)
    if entry.stem.casefold().startswith(_EXPLORE):
        unfinished = unfinished | _OF_EXPLORE
    return bool(defined - unfinished)


def _is_untouched(entry: Entry) -> bool:
    """Say whether every function of a file is as unfinished as it was handed out."""
    return _functions(entry)[1] >= CORE


def _functions(entry: Entry) -> tuple[set[bytes], set[bytes]]:
    """Find which of the main functions a file defines, and which of them are still as they were handed out."""
    try:
        data = b"" if entry.problem else entry.load(_LARGEST)
    except RejectedUpload:
        return set(), set()
    if len(data) > _LARGEST:
        return set(CORE), set()
    return CORE.intersection(_DEFINED.findall(data)), CORE.intersection(_OPEN.findall(data))


def without_companions(entries: Sequence[Entry]) -> list[Entry]:
    """Leave out files that go with Python code (setup.py, tests, __init__.py), unless nothing is left."""
    return [entry for entry in entries if not _COMPANIONS.fullmatch(entry.name)] or list(entries)


def strays(entries: Iterable[Entry], system: str) -> list[Upload]:
    """Report the submissions that lie where a layout has none: nobody is guessed to be their owner."""
    words = "lies where this layout has no submissions, so whose it is cannot be told; give it by itself"
    nobody = Owner(system)
    return [Upload(entry.stem, entry, entry.problem or words, owner=nobody) for entry in entries if is_candidate(entry)]


def listing(names: Sequence[str], limit: int = 4) -> str:
    """List names for a message, the first few of them.

    Examples
    --------
    >>> listing(["a.py", "b.py"]), listing(list("abcdef"), limit=2)
    ('a.py, b.py', 'a, b and 4 more')
    """
    shown = ", ".join(printable(name)[:60] for name in names[:limit])
    return f"{shown} and {len(names) - limit} more" if len(names) > limit else shown
