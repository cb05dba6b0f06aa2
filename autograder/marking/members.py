"""Who belongs to the folder of a run: one record in it that every command reads, and every change of it in words."""

from __future__ import annotations

import contextlib
import shlex
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import msgspec

from autograder.errors import UsageError
from autograder.writing import write_whole

FILE = "members.json"
_LISTED = 5


class Members(msgspec.Struct, frozen=True, kw_only=True):
    """The record: what each submission was read from, who is kept aside, and who is on the roster.

    A submission that the record does not know belongs to the folder when its result lies there.
    """

    sources: dict[str, tuple[str, ...]] = {}
    aside: tuple[str, ...] = ()
    roster: tuple[str, ...] = ()


@dataclass(frozen=True)
class Change:
    """What a run changes about who belongs to a folder, before it is written down.

    Parameters
    ----------
    record : Members
        The new record.
    gone : tuple of str
        Who is kept aside from now on.
    staying : tuple of str
        Members that are not among the uploads of the run.
    notes : tuple of str
        The change in words.
    """

    record: Members
    gone: tuple[str, ...]
    staying: tuple[str, ...]
    notes: tuple[str, ...]


def read_members(out: Path) -> Members:
    """Read the record; an empty one where there is none.

    Raises
    ------
    UsageError
        Where the file is damaged: nobody is dropped or brought back by that.
    """
    path = out / FILE
    try:
        return msgspec.json.decode(path.read_bytes(), type=Members)
    except FileNotFoundError:
        return Members()
    except (OSError, msgspec.MsgspecError) as error:
        raise UsageError(
            f"{path} cannot be read as the record of who belongs to this folder ({error}); restore it, or delete it, "
            "and everybody with a result there belongs to it again."
        ) from None


def members_after(
    out: Path, paths: Sequence[Path], names: Iterable[str], roster: Iterable[str] = (), *, some: bool = False
) -> Change:
    """Find out who belongs to a folder after the uploads of a run; nothing is written.

    Who was read from what is given now, and is not found there any more, is kept aside: in no report and no export,
    with its result still on disk. Who came from elsewhere stays.

    Parameters
    ----------
    out : Path
        The folder of the run.
    paths : sequence of Path
        What the uploads were read from.
    names : iterable of str
        The submissions found there, graded or not.
    roster : iterable of str
        Ids of the class, where there is a roster.
    some : bool
        Whether only some of them are graded, so that the others need no word.
    """
    old, here = read_members(out), set(names)
    given = tuple(sorted({str(path.resolve()) for path in paths}))
    known = (set(old.sources) | _stored(out)) - here - set(old.aside)
    gone = sorted(name for name in known if name in old.sources and _covered(old.sources[name], given))
    staying = tuple(sorted(known - set(gone)))
    back = sorted(here & set(old.aside))
    moved = sorted(
        name for name in here & set(old.sources) if not (_covered(old.sources[name], given) or name in old.aside)
    )
    moved = [name for name in moved if not _covered(given, old.sources[name])]
    sources = {name: old.sources[name] for name in old.sources if name not in here} | dict.fromkeys(here, given)
    aside = tuple(sorted((set(old.aside) - here) | set(gone)))
    record = Members(sources=sources, aside=aside, roster=tuple(roster) or old.roster)
    notes = []
    if gone:
        notes.append(
            f"{_submissions(gone, 'was', 'were')} handed in before and {'is' if len(gone) == 1 else 'are'} gone now "
            f"({_some(gone)}): kept aside; `autograder report {shlex.quote(str(out))} --forget NAME` drops it."
        )
    if back:
        notes.append(f"{_submissions(back, 'was', 'were')} kept aside and handed in again: {_some(back)}.")
    if moved:
        notes.append(f"{_submissions(moved, 'comes', 'come')} from another place than before: {_some(moved)}.")
    if staying and not some:
        notes.append(
            f"{_submissions(staying, 'is', 'are')} not in what was given now and "
            f"{'stays' if len(staying) == 1 else 'stay'} ({_some(staying)}); "
            f"`autograder report {shlex.quote(str(out))} --forget NAME` drops one."
        )
    return Change(record, tuple(gone), staying, tuple(notes))


def enter_members(out: Path, change: Change) -> None:
    """Write a change down; students see no page of an upload that is gone."""
    _write(out, change.record)
    for name in change.gone:
        _remove(out / "feedback" / f"{name}.html")


def forget(out: Path, names: Sequence[str]) -> None:
    """Drop submissions for good: their results, their pages, and their place in the record.

    Raises
    ------
    UsageError
        Where one of them is not there; then none is dropped.
    """
    record, stored = read_members(out), _stored(out)
    for name in names:
        if name not in stored:
            aside = f"; kept aside are {_some(record.aside)}" if record.aside else ""
            raise UsageError(f"--forget {name}: {out} holds no submission of this name{aside}.")
    for name in names:
        _remove(out / "results" / f"{name}.json")
        _remove(out / "feedback" / f"{name}.html")
    dropped = set(names)
    sources = {name: paths for name, paths in record.sources.items() if name not in dropped}
    left = tuple(name for name in record.aside if name not in dropped)
    _write(out, Members(sources=sources, aside=left, roster=record.roster))


def _write(out: Path, record: Members) -> None:
    data = msgspec.json.encode(record, order="deterministic")
    write_whole(out / FILE, msgspec.json.format(data, indent=2) + b"\n")


def _stored(out: Path) -> set[str]:
    return {path.stem for path in (out / "results").glob("[!.]*.json")}


def _covered(sources: Sequence[str], given: Sequence[str]) -> bool:
    """Whether everything that a submission was read from lies in what is given."""
    return all(any(Path(source).is_relative_to(path) for path in given) for source in sources)


def _submissions(names: Sequence[str], one: str, many: str) -> str:
    return f"1 submission {one}" if len(names) == 1 else f"{len(names)} submissions {many}"


def _some(names: Sequence[str]) -> str:
    return ", ".join(names[:_LISTED]) + (", ..." if len(names) > _LISTED else "")


def _remove(path: Path) -> None:
    """Remove a file, where there is one; a name that this locale cannot spell names none that it could have written."""
    with contextlib.suppress(UnicodeEncodeError):
        path.unlink(missing_ok=True)
