"""A notebook becomes the texts of its code cells: read by name of field, within bounds, nothing executed.

Only `cell_type` and `source` of each cell count, and the pictures that a markdown cell shows. Ids, metadata, outputs
and execution counts are skipped while reading, never built: a notebook whose cells were duplicated, retyped or stripped
of metadata reads like any other, and what its outputs claim is not seen. Of the notebook's own metadata one short text
is read, the variant that it was handed out with; it is a claim, and counts last. Where a key stands twice the last one
counts, as in Jupyter.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

import msgspec

from autograder.errors import RejectedUpload
from autograder.intake.module import MAX_SOURCE, one_newline, reject_foreign
from autograder.intake.pictures import MAX_PICTURES, with_pictures

MAX_NOTEBOOK = 20 << 20  # bytes of the file, outputs included
MAX_CELLS = 10_000
_LONGEST_NAME = 64  # of a variant
_MAX_RAW = 6 * MAX_SOURCE  # a source as JSON: escapes make it longer, at most six bytes for one
_MAX_ATTACHED = 8 << 20  # bytes of the attachments of one cell as JSON; of pictures less than that is shown
_UTF8_MARK = b"\xef\xbb\xbf"
_HIGH, _LOW = rb"\\u[dD][89abAB][0-9a-fA-F]{2}", rb"\\u[dD][c-fC-F][0-9a-fA-F]{2}"
_SURROGATES = re.compile(rb"(?<!\\)((?:\\\\)*)(?:(%b%b)|%b|%b)" % (_HIGH, _LOW, _HIGH, _LOW))
_OLD_FORMAT = "is a notebook of format {}, expected 4; open it in a current Jupyter, save it and hand it in again"


_WITHOUT_ENDS = "is a list of lines without line ends; they were put one below the other"
_UNREADABLE = "has no readable text (expected a text or a list of lines) and was taken as empty"


class _Cell(msgspec.Struct, gc=False):
    """A cell as written; `source`, `input` in format 3, stays undecoded until its length is known to be fit."""

    cell_type: str
    source: msgspec.Raw | msgspec.UnsetType = msgspec.UNSET
    input: msgspec.Raw | msgspec.UnsetType = msgspec.UNSET
    attachments: msgspec.Raw | msgspec.UnsetType = msgspec.UNSET
    execution_count: msgspec.Raw | msgspec.UnsetType = msgspec.UNSET

    @property
    def text(self) -> msgspec.Raw | msgspec.UnsetType:
        """What was typed into the cell."""
        return self.input if isinstance(self.source, msgspec.UnsetType) else self.source


class _Worksheet(msgspec.Struct):
    cells: list[_Cell] = []


class _Notebook(msgspec.Struct):
    cells: list[_Cell] | msgspec.UnsetType = msgspec.UNSET
    worksheets: msgspec.Raw | msgspec.UnsetType = msgspec.UNSET  # where formats 2 and 3 keep their cells
    nbformat: msgspec.Raw | msgspec.UnsetType = msgspec.UNSET
    metadata: msgspec.Raw | msgspec.UnsetType = msgspec.UNSET


class _HandedOut(msgspec.Struct):
    variant: str = ""


class _Metadata(msgspec.Struct):
    slam1d: _HandedOut = msgspec.field(default_factory=_HandedOut)


_METADATA = msgspec.json.Decoder(_Metadata)
_NOTEBOOK = msgspec.json.Decoder(_Notebook)
_ATTACHMENTS = msgspec.json.Decoder(dict[str, msgspec.Raw])  # each is read only where the cell shows it
_WORKSHEETS = msgspec.json.Decoder(list[_Worksheet])
_SOURCE = msgspec.json.Decoder(str | list[str])


@dataclass(frozen=True)
class Notebook:
    """The texts of a notebook, in order: what may be executed, what a human may read, and the variant it claims."""

    code: tuple[str, ...]
    markdown: tuple[str, ...]
    notes: tuple[str, ...] = ()
    variant: str = ""
    pictures: Mapping[str, str] = field(default_factory=dict)
    labels: tuple[str, ...] = ()
    """What each code cell is called: its place among all cells, and the number that Jupyter shows beside it."""
    flags: tuple[str, ...] = ()
    """What a human should look at: cells that were not read as they are written."""


def read_notebook(data: bytes) -> Notebook:
    """Read a notebook of format 4 or 3; raises RejectedUpload with the end of a sentence where it is none."""
    if len(data) > MAX_NOTEBOOK:
        raise RejectedUpload("is larger than 20 MiB; clear all outputs in Jupyter, save it and hand it in again")
    reject_foreign(data)
    notebook = _decode(data)
    version = _version(notebook.nbformat)
    cells = _cells(notebook, version)
    code, labels, notes = _code(cells)
    flags = [note for note in notes if _UNREADABLE in note or _WITHOUT_ENDS in note][:1]
    if not code:
        notes.append("The notebook has no code cell.")
    if version not in ("3", "4"):
        notes.append(f"The notebook names its format {version!r}, not 4; its cells were read all the same.")
    markdown, pictures = _markdown(cells)
    return Notebook(
        tuple(code), tuple(markdown), tuple(notes), _variant(notebook.metadata), pictures, tuple(labels), tuple(flags)
    )


def _cells(notebook: _Notebook, version: str) -> list[_Cell]:
    """Return the cells, wherever the format keeps them."""
    cells = notebook.cells
    if isinstance(cells, msgspec.UnsetType) and not isinstance(notebook.worksheets, msgspec.UnsetType):
        cells = _worksheets(notebook.worksheets, version)
    if version in ("1", "2"):
        raise RejectedUpload(_OLD_FORMAT.format(version))
    if isinstance(cells, msgspec.UnsetType):
        raise RejectedUpload("is JSON but no notebook (it has no cells); save the notebook in Jupyter and hand in that")
    if not cells:
        raise RejectedUpload("is a notebook without cells; check that you handed in the file you worked in")
    if len(cells) > MAX_CELLS:
        raise RejectedUpload(f"has {len(cells)} cells, more than the limit of {MAX_CELLS}")
    return cells


def _worksheets(raw: msgspec.Raw, version: str) -> list[_Cell]:
    """Return the cells of format 3, sheet after sheet."""
    try:
        return [cell for sheet in _WORKSHEETS.decode(raw) for cell in sheet.cells]
    except (msgspec.DecodeError, RecursionError, ValueError):
        raise RejectedUpload(_OLD_FORMAT.format(version or "3")) from None


def looks_like_notebook(data: bytes) -> bool:
    """Say whether the bytes are a notebook by their content, whatever the file is called."""
    head = data[:200].removeprefix(_UTF8_MARK).lstrip()
    return head.startswith(b"{") and b'"cell_type"' in data and b'"nbformat"' in data


def _decode(data: bytes) -> _Notebook:
    body = data.removeprefix(_UTF8_MARK)
    try:
        return _parse(body)
    except RecursionError:
        raise RejectedUpload("is JSON nested too deeply for a notebook; save it in Jupyter again") from None
    except msgspec.ValidationError as error:
        raise RejectedUpload(f"is JSON but no notebook ({error}); save it in Jupyter and hand it in again") from None
    except (msgspec.DecodeError, ValueError) as error:
        if not body.strip():
            raise RejectedUpload("is empty, expected a notebook; save it in Jupyter and hand it in again") from None
        if b"<<<<<<< " in body and b">>>>>>> " in body:
            raise RejectedUpload("holds an unfinished git merge; resolve it, open it in Jupyter and save it") from None
        if body.lstrip()[:1] == b"<":
            raise RejectedUpload(
                "is a web page, no notebook; it may be a page that asks to sign in: download the notebook again"
            ) from None
        if not body.lstrip().startswith(b"{"):
            raise RejectedUpload("is no notebook (not JSON); a Python file needs a name that ends in .py") from None
        if "truncated" in str(error):
            raise RejectedUpload("is cut off before its end; save it in Jupyter and hand it in again") from None
        at = re.search(r"\(byte (\d+)\)", str(error))
        line = body.count(b"\n", 0, int(at[1])) + 1 if at else 0
        where = f" (line {line})" if at else ""
        raise RejectedUpload(f"is no valid JSON{where}, so no notebook; open it in Jupyter and save it again") from None


def _parse(body: bytes) -> _Notebook:
    """Decode the JSON; half a surrogate pair, which Python writes and JSON forbids, is replaced."""
    try:
        return _NOTEBOOK.decode(body)
    except msgspec.ValidationError:
        raise
    except msgspec.DecodeError:
        if b"\\ud" not in body and b"\\uD" not in body:
            raise
        if (mended := _SURROGATES.sub(lambda found: found[1] + (found[2] or rb"\ufffd"), body)) == body:
            raise
        return _NOTEBOOK.decode(mended)


def _version(raw: msgspec.Raw | msgspec.UnsetType) -> str:
    """Return `nbformat` as it is written, at most a few characters of it."""
    return "" if isinstance(raw, msgspec.UnsetType) else bytes(raw)[:12].decode("ascii", "replace").removesuffix(".0")


def _variant(raw: msgspec.Raw | msgspec.UnsetType) -> str:
    """Return the variant that the metadata name; "" where they name none, whatever else they hold."""
    if isinstance(raw, msgspec.UnsetType):
        return ""
    try:
        stated = _METADATA.decode(raw).slam1d.variant
    except (msgspec.DecodeError, RecursionError, ValueError):
        return ""
    return stated if len(stated) <= _LONGEST_NAME and stated.isprintable() else ""


def _code(cells: list[_Cell]) -> tuple[list[str], list[str], list[str]]:
    code: list[str] = []
    labels: list[str] = []
    notes: list[str] = []
    unreadable = 0
    raw_left, left = _MAX_RAW, MAX_SOURCE
    for number, cell in enumerate(cells, start=1):
        if cell.cell_type == "code":
            raw_left -= 0 if isinstance(cell.text, msgspec.UnsetType) else memoryview(cell.text).nbytes
            text, odd = _text(cell) if raw_left >= 0 else ("", "")
            left -= len(text.encode())
            if min(raw_left, left) < 0:
                raise RejectedUpload("has more than 1 MiB of code; move data out of the cells")
            code.append(text)
            labels.append(_label(cell, number))
            unreadable += odd == _UNREADABLE
            if odd:
                notes.append(f"{labels[-1].capitalize()} {odd}.")
        elif cell.cell_type not in ("markdown", "raw", "heading"):
            notes.append(f"Cell {number} is of the unknown type {cell.cell_type[:20]!r} and was not read.")
    if code and unreadable == len(code):
        raise RejectedUpload(f"has no readable text in any of its {unreadable} code cells; save it in Jupyter again")
    return code, labels, notes[:5]


def _label(cell: _Cell, number: int) -> str:
    """Name a cell as its reader sees it: Jupyter numbers what was run, other programs count all cells."""
    shown = b"" if isinstance(cell.execution_count, msgspec.UnsetType) else bytes(cell.execution_count)
    return f"cell {number} (In [{int(shown)}])" if shown.isdigit() and len(shown) < 7 else f"cell {number}"


def _markdown(cells: list[_Cell]) -> tuple[list[str], dict[str, str]]:
    """Return the markdown cells, as far as they are readable and together within the limit of code, with pictures."""
    texts: list[str] = []
    pictures: dict[str, str] = {}
    pictures_left = MAX_PICTURES
    raw_left = _MAX_RAW
    for cell in cells:
        if cell.cell_type == "markdown" and not isinstance(cell.source, msgspec.UnsetType):
            raw_left -= memoryview(cell.source).nbytes
            if raw_left < 0:
                break
            text, _ = _text(cell)
            if "attachment:" in text:
                text, found, pictures_left = with_pictures(text, _attached(cell), pictures_left)
                pictures |= found
            texts.append(text)
    return texts, pictures


def _attached(cell: _Cell) -> dict[str, msgspec.Raw]:
    if isinstance(cell.attachments, msgspec.UnsetType) or memoryview(cell.attachments).nbytes > _MAX_ATTACHED:
        return {}
    try:
        return _ATTACHMENTS.decode(cell.attachments)
    except (msgspec.DecodeError, RecursionError, ValueError):
        return {}


def _text(cell: _Cell) -> tuple[str, str]:
    """Return the text of a cell, and what is odd about how it is written, as the end of a sentence."""
    raw = cell.text
    if isinstance(raw, msgspec.UnsetType):
        return "", ""
    try:
        source = _SOURCE.decode(raw)
    except (msgspec.DecodeError, RecursionError, ValueError):
        return "", _UNREADABLE
    if isinstance(source, str):
        return one_newline(source), ""
    if len(source) > 1 and all(line.splitlines() == [line] for line in source if line):
        return one_newline("\n".join(source)), _WITHOUT_ENDS
    return one_newline("".join(source)), ""
