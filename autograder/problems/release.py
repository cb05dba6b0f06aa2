"""A release: a folder and a zip for every student, and a staff folder with the ledger and the keys.

What a student's folder holds is rendered elsewhere and handed in; it is given the variant's problem
and nothing that is for staff. Every file appears whole or not at all, and a second run finds
everything done.
"""

from __future__ import annotations

import csv
import io
import json
import shutil
import zipfile
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path

from autograder.errors import UsageError
from autograder.lifeline import live_with_parent
from autograder.problems.drawing import checked_mix, draw_class
from autograder.problems.hand_solution import hand_solution
from autograder.problems.ledger import Ledger, read_ledger, write_ledger
from autograder.problems.listing import key_columns, key_row
from autograder.problems.problem import Problem
from autograder.problems.replacing import UNFINISHED, replace_file, replace_folder
from autograder.problems.roster import Student
from autograder.problems.secret import Secret
from autograder.problems.variants import Variant

Render = Callable[[Problem], Mapping[str, str]]

__all__ = ["EXAM", "LEDGER", "Released", "release"]

STAFF = "staff"
LEDGER = f"{STAFF}/variants.csv"
RECORD = f"{STAFF}/release.json"
EXAM = f"{STAFF}/exam"
STUDENTS = "students"
ZIPS = "zips"
ZIP_TIME = (1980, 1, 1, 0, 0, 0)  # the earliest that a zip can hold: the same files give the same bytes


@dataclass(frozen=True)
class Released:
    """What a release did.

    Parameters
    ----------
    new, unchanged, rewritten : tuple of str
        Ids whose folder was made, was there already, or was made again.
    different : tuple of str
        Ids whose folder is not what would be rendered today; left as it is.
    gone : tuple of str
        Ids of the ledger that the roster does not have; their folders stay.
    redrawn : mapping
        How many draws were thrown away, by reason.
    """

    new: tuple[str, ...]
    unchanged: tuple[str, ...]
    rewritten: tuple[str, ...]
    different: tuple[str, ...]
    gone: tuple[str, ...]
    redrawn: Mapping[str, int]

    def text(self) -> str:
        """Say it in a few lines."""
        lines = [f"{len(self.new)} new, {len(self.unchanged)} unchanged, {len(self.rewritten)} rewritten."]
        if self.different:
            lines.append(
                f"{len(self.different)} folders were left although their files would be rendered otherwise today "
                f"({_some(self.different)}); --force renders them again."
            )
        if self.gone:
            lines.append(f"{len(self.gone)} earlier students are not on the roster ({_some(self.gone)}); theirs stay.")
        lines += [f"{count} draws redrawn: {reason}." for reason, count in sorted(self.redrawn.items())]
        return "\n".join(lines)


def release(
    students: Sequence[Student],
    secret: Secret,
    term: str,
    mix: Mapping[str, int],
    out: Path,
    *,
    render: Render,
    render_key: Render | None = None,
    accept: Callable[[Variant], bool] | None = None,
    notes: Mapping[str, str] | None = None,
    force: bool = False,
    workers: int = 1,
    on_draw: Callable[[int, int, str], None] | None = None,
    on_progress: Callable[[int, int, str], None] | None = None,
) -> Released:
    """Give every student of the roster a variant, a folder and a zip.

    Parameters
    ----------
    students : sequence of Student
        The roster.
    secret, term
        What the variants depend on.
    mix : mapping
        Label of a family -> weight.
    out : Path
        Folder of the release; made where it is missing.
    render : callable
        From a problem to the files of a student's folder, text by name. With several workers it
        must be a function that another process can import.
    render_key : callable, optional
        From a problem to further files for staff, text by kind of file (".md"), in the same way.
    accept : callable, optional
        A further demand on a variant.
    notes : mapping, optional
        Further files for staff, text by name.
    force : bool
        Go on although secret or term have changed, and render folders again that have changed.
    workers : int
        Processes that render and write.
    on_draw, on_progress : callable, optional
        Called with (done, total, student id) after every draw, and after every student's files.

    Raises
    ------
    UsageError
        Where the folder belongs to another secret or term, or cannot be written.
    """
    labels = checked_mix(mix)
    try:
        stated = {"term": term, "secret_check": secret.check(term), "mix": dict(sorted(labels.items())), "format": 1}
        record = json.dumps(stated, indent=2) + "\n"
        _check_record(out / RECORD, stated, force)
        ledger = read_ledger(out / LEDGER) if (out / LEDGER).exists() else Ledger()
        tally: Counter[str] = Counter()
        ids = [student.student_id for student in students]
        draw_class(ledger, ids, secret, term, labels, accept=accept, tally=tally, on_draw=on_draw)
        _put(out / RECORD, record.encode())
        write_ledger(out / LEDGER, ledger)
        for name, text in (notes or {}).items():
            _put(out / STAFF / name, text.encode())
        _put(out / STAFF / "keys.csv", _key_table(ledger))
        for leftover in (out / STUDENTS).glob(f"{UNFINISHED}*"):
            shutil.rmtree(leftover)
        present = [variant for student in students if (variant := ledger.get(student.student_id))]
        tasks = [_Task(variant, out, render, render_key, force) for variant in present]
        done: dict[str, list[str]] = {kind: [] for kind in ("new", "unchanged", "rewritten", "different")}
        for count, (variant, kind) in enumerate(zip(present, _write_all(tasks, workers), strict=True), 1):
            done[kind].append(variant.student_id)
            if on_progress is not None:
                on_progress(count, len(present), variant.student_id)
    except OSError as error:
        raise UsageError(f"Release folder {out} cannot be written ({error.strerror}: {error.filename}).") from None
    here = {student.student_id.casefold() for student in students}
    gone = tuple(variant.student_id for variant in ledger if variant.student_id.casefold() not in here)
    return Released(
        new=tuple(done["new"]),
        unchanged=tuple(done["unchanged"]),
        rewritten=tuple(done["rewritten"]),
        different=tuple(done["different"]),
        gone=gone,
        redrawn=tally,
    )


def _check_record(path: Path, stated: Mapping[str, object], force: bool) -> None:
    """Refuse to go on with other numbers than those that the folder was made with; an old record holds no mix."""
    if not path.exists() or force:
        return
    try:
        before = json.loads(path.read_text(encoding="utf-8"))
    except ValueError:
        before = None
    if not isinstance(before, dict):
        raise UsageError(f"{path} is damaged; restore it from a copy, or --force to write it anew.")
    other = "secret or term" if any(before.get(key) != stated[key] for key in ("term", "secret_check")) else ""
    if not other and before.get("mix", stated["mix"]) != stated["mix"]:
        other = f"mix of families ({', '.join(before['mix'])})"
    if other:
        raise UsageError(
            f"Release folder {path.parent.parent} was made with another {other}; "
            "choose another folder, or --force to add only the new students under this one."
        )


@dataclass(frozen=True)
class _Task:
    """Everything that one student's folder needs: it travels to another process."""

    variant: Variant
    out: Path
    render: Render
    render_key: Render | None
    force: bool


def _write(task: _Task) -> str:
    """Write one student's folder and zip; return what was done."""
    name = task.variant.student_id
    files = {file: text.encode("utf-8") for file, text in task.render(task.variant.problem).items()}
    folder = task.out / STUDENTS / name
    kind = "new"
    if folder.is_dir():
        paths = [(folder / file, data) for file, data in files.items()]
        same = all(path.is_file() and path.read_bytes() == data for path, data in paths)
        kind = "unchanged" if same else "rewritten" if task.force else "different"
    if kind in {"new", "rewritten"}:
        replace_folder(folder, files)
    if kind != "different":
        _put(task.out / ZIPS / f"{name}.zip", _zipped(name, files))
    _put(task.out / STAFF / "solutions" / f"{name}.md", hand_solution(task.variant).encode())
    if task.render_key is not None:
        for suffix, text in task.render_key(task.variant.problem).items():
            _put(task.out / STAFF / "worked" / f"{name}{suffix}", text.encode())
    return kind


def _write_all(tasks: Sequence[_Task], workers: int) -> Iterator[str]:
    """Write all folders, in several processes where that is worth their start."""
    if workers < 2 or len(tasks) < 20:
        yield from map(_write, tasks)
        return
    with ProcessPoolExecutor(workers, mp_context=get_context("spawn"), initializer=live_with_parent) as pool:
        yield from pool.map(_write, tasks, chunksize=5)


def _zipped(student_id: str, files: Mapping[str, bytes]) -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in sorted(files.items()):
            entry = zipfile.ZipInfo(f"{student_id}/{name}", ZIP_TIME)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, data, compresslevel=1)  # a third of the time, and a fifth more bytes
    return buffer.getvalue()


def _put(path: Path, data: bytes) -> None:
    """Write a file unless it holds just this."""
    if not (path.is_file() and path.read_bytes() == data):
        replace_file(path, data)


def _key_table(ledger: Ledger) -> bytes:
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(key_columns())
    writer.writerows(map(key_row, ledger))
    return buffer.getvalue().encode()


def _some(ids: Sequence[str]) -> str:
    return ", ".join(ids[:3]) + (", ..." if len(ids) > 3 else "")
