"""The bytes of one upload become a source: a module, a notebook, or an archive with one of them in it."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from autograder.errors import RejectedUpload
from autograder.intake.archive import MAX_ARCHIVE, archive_tree
from autograder.intake.module import read_module
from autograder.intake.naming import printable
from autograder.intake.notebook import MAX_NOTEBOOK, looks_like_notebook, read_notebook
from autograder.intake.tree import Entry
from autograder.intake.upload import choose
from autograder.sandbox.frames import Source


@dataclass(frozen=True)
class Content:
    """What an upload holds: source, markdown for a human reader, remarks about the reading, the variant it claims."""

    source: Source
    markdown: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    variant: str = ""
    pictures: Mapping[str, str] = field(default_factory=dict)
    flags: tuple[str, ...] = ()


def read_entry(entry: Entry) -> Content:
    """Read an upload; raises RejectedUpload with the end of a sentence ("is ...", "holds ...")."""
    if entry.problem:
        raise RejectedUpload(entry.problem)
    data = entry.load(
        MAX_ARCHIVE if entry.suffix == ".zip" else MAX_NOTEBOOK
    )  # whatever its name, it may be a notebook
    if entry.suffix == ".zip":
        return _read_archive(data)
    if entry.suffix == ".ipynb":
        return _read_notebook(data, entry.name)
    if looks_like_notebook(data):
        content = _read_notebook(data, entry.name)
        return replace(content, notes=(*content.notes, "Read as a notebook: its content is one, whatever its name."))
    source = Source(kind="module", cells=[read_module(data)], name=printable(entry.name))
    return Content(source, notes=() if data.strip() else ("The file is empty.",))


def digest(source: Source) -> str:
    """Return the SHA-256 of kind and cells, as hex; names do not count."""
    state = hashlib.sha256(source.kind.encode())
    for cell in source.cells:
        text = cell.encode()
        state.update(len(text).to_bytes(8, "little"))
        state.update(text)
    return state.hexdigest()


def _read_notebook(data: bytes, name: str) -> Content:
    notebook = read_notebook(data)
    source = Source("notebook", list(notebook.code), printable(name), list(notebook.labels))
    return Content(source, notebook.markdown, notebook.notes, notebook.variant, notebook.pictures, notebook.flags)


def _read_archive(data: bytes) -> Content:
    """Read the one submission in an archive; archives in an archive were refused with it."""
    entry, problem, notes = choose(archive_tree(data).entries)
    if entry is None:
        raise RejectedUpload(problem + "; an archive of a whole class is unpacked first" * ("submissions" in problem))
    try:
        content = read_entry(entry)
    except RejectedUpload as error:
        raise RejectedUpload(f"holds {printable(entry.name)[:80]}, which {error}") from None
    place = printable("/".join(entry.parts))[:120]
    return replace(content, notes=(f"Read from {place} in the archive.", *notes, *content.notes))
