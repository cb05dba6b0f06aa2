"""One upload: whose file it is, and which file counts where there are several."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from autograder.errors import RejectedUpload
from autograder.intake.naming import printable
from autograder.intake.tree import PROVIDED_FILES, Entry, is_candidate

EXPECTED = "expected one .py, .ipynb or .zip file"
HOMEWORK = "slam1d"  # the name under which the homework is handed out
CORE = {b"residual", b"jacobian", b"information_matrix", b"normal_equations", b"gauss_newton_step"}
_OPEN = re.compile(rb"\b(\w{1,40}) is not finished yet: replace this line")  # what a stub raises, as handed out
_LARGEST_STUB = 1 << 20  # bytes
_COMPANIONS = re.compile(r"(__init__|conftest|setup|noxfile|test_.*|.*_test)\.py", re.IGNORECASE)
_WRONG_KINDS = re.compile(r".*(\.(rar|7z|tar|tgz|gz|bz2|xz|pyw|pyc)|\.(py|ipynb)\.(txt|json|html))", re.IGNORECASE)


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
    student_id : str or None
        The id that the system of the course gave the student.
    late : bool or None
        Whether the system marked it late; None where the layout does not say.
    submitted : str
        When it was handed in, as the layout has it; "" where it does not say.
    """

    name: str
    entry: Entry | None
    problem: str = ""
    folder: str = ""
    notes: tuple[str, ...] = ()
    student_id: str | None = None
    late: bool | None = None
    submitted: str = ""


def choose(entries: Sequence[Entry]) -> tuple[Entry | None, str, tuple[str, ...]]:
    """Pick the one file that counts among those of one student: (entry, problem, notes).

    Nothing is guessed: of several files only one that has the name of the homework is taken, and that is noted. Where
    module and notebook were both handed in, because they were handed out together, the one in which no function was
    begun does not count.
    """
    candidates = [entry for entry in entries if is_candidate(entry)]
    if len(candidates) > 1:
        candidates = without_companions(candidates)
    if len(candidates) == 1:
        return candidates[0], "", ()
    named = [entry for entry in candidates if entry.stem.casefold() == HOMEWORK]
    if len(named) > 1:
        named = [entry for entry in named if not _is_untouched(entry)]
    if len(named) == 1:
        others = listing([entry.name for entry in candidates if entry is not named[0]])
        return named[0], "", (f"Graded {named[0].name}; also handed in and not graded: {others}.",)
    if candidates:
        names = listing([entry.name for entry in candidates])
        return None, f"holds {len(candidates)} submissions ({names}), {EXPECTED}; keep the one that counts", ()
    found = [entry.name for entry in entries]
    if any(name.casefold() in PROVIDED_FILES for name in found):
        return None, f"holds only files that were handed out ({listing(found)}), {EXPECTED}", ()
    return None, f"holds no submission (found {listing(found) or 'nothing'}), {EXPECTED}", ()


def _is_untouched(entry: Entry) -> bool:
    """Say whether every function of a file is as unfinished as it was handed out."""
    try:
        data = entry.load(_LARGEST_STUB)
    except RejectedUpload:
        return False
    return CORE.issubset(_OPEN.findall(data))


def without_companions(entries: Sequence[Entry]) -> list[Entry]:
    """Leave out files that go with Python code (setup.py, tests, __init__.py), unless nothing is left."""
    return [entry for entry in entries if not _COMPANIONS.fullmatch(entry.name)] or list(entries)


def is_wrong_kind(entry: Entry) -> bool:
    """Say whether a file was clearly meant as a submission but has a kind that is not read (a .rar, a .py.txt).

    Examples
    --------
    >>> [is_wrong_kind(Entry((name,), name)) for name in ("a.rar", "a.py.txt", "a.tar.gz", "notes.txt", "a.py")]
    [True, True, True, False, False]
    """
    return _WRONG_KINDS.fullmatch(entry.name) is not None


def wrong_kind_problem(entry: Entry) -> str:
    """Say what came and what was expected, as the end of a sentence."""
    return f"is a {entry.suffix or 'file without a suffix'}, {EXPECTED}; save or pack it as one of these"


def strays(entries: Iterable[Entry]) -> list[Upload]:
    """Report the submissions that lie where a layout has none: nobody is guessed to be their owner."""
    words = "lies where this layout has no submissions, so whose it is cannot be told; give it by itself"
    return [Upload(entry.stem, entry, entry.problem or words) for entry in entries if is_candidate(entry)]


def listing(names: Sequence[str], limit: int = 4) -> str:
    """List names for a message, the first few of them.

    Examples
    --------
    >>> listing(["a.py", "b.py"]), listing(list("abcdef"), limit=2)
    ('a.py, b.py', 'a, b and 4 more')
    """
    shown = ", ".join(printable(name)[:60] for name in names[:limit])
    return f"{shown} and {len(names) - limit} more" if len(names) > limit else shown
