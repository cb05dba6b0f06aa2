"""The worst upload of each kind, near the largest that is read: what takes long where work is not linear in it."""

from __future__ import annotations

import base64
import io
import json
import zipfile
import zlib
from collections.abc import Callable

from autograder.intake.archive import MAX_ARCHIVE
from autograder.intake.module import MAX_SOURCE
from autograder.intake.notebook import MAX_CELLS, MAX_NOTEBOOK

CODE = '{"cell_type": "code", "source": "x = 1"}'


def notebook(cells: str, more: str = "") -> bytes:
    """Write a notebook around cells that are JSON already."""
    return f'{{"nbformat": 4, {more} "metadata": {{}}, "cells": [{cells}]}}'.encode()


def markdown(text: str, attachments: str = "{}") -> str:
    """Write one markdown cell around attachments that are JSON already."""
    return f'{{"cell_type": "markdown", "attachments": {attachments}, "source": {json.dumps(text)}}}'


def filled(piece: str, size: int) -> str:
    """Repeat a text up to a size."""
    return piece * (size // len(piece))


def attachments() -> bytes:
    """Many attachments, none of them the one that is named again and again."""
    table = ",".join(f'"{k}":{{}}' for k in range(600_000))
    return notebook(markdown(filled("attachment:zzzzz ", 5 << 20), f"{{{table}}}"))


def attachments_that_are_named() -> bytes:
    """Every attachment is named once, and each is a different picture that is too small to be one."""
    table = ",".join(f'"{k}":{{"image/png":"iVBORw0KGgo{k:08d}"}}' for k in range(150_000))
    return notebook(markdown("".join(f"attachment:{k} " for k in range(150_000)), f"{{{table}}}"))


def media_types() -> bytes:
    """One attachment in very many media types."""
    kinds = ",".join(f'"{k}":"iVBORw0KGgo="' for k in range(300_000))
    return notebook(markdown("attachment:a", f'{{"a":{{{kinds}}}}}'))


def chunks() -> bytes:
    """A picture of nothing but empty chunks."""
    empty = b"\0\0\0\0IDAT" + zlib.crc32(b"IDAT").to_bytes(4, "big")
    head = b"IHDR" + b"\0\0\0\1" * 2 + b"\x08\0\0\0\0"
    data = b"\x89PNG\r\n\x1a\n\0\0\0\x0d" + head + zlib.crc32(head).to_bytes(4, "big") + empty * 40_000
    text = base64.b64encode(data).decode()
    table = ",".join(f'"{k}":{{"image/png":"{text}"}}' for k in range(11))
    return notebook(markdown(" ".join(f"attachment:{k}" for k in range(11)), f"{{{table}}}"))


def cells() -> bytes:
    """As many cells as are read, and far more."""
    return notebook(",".join([CODE] * MAX_CELLS))


def too_many_cells() -> bytes:
    """A file full of cells."""
    return notebook(filled(CODE + ",", MAX_NOTEBOOK - 200) + CODE)


def keys() -> bytes:
    """Metadata and cells of nothing but keys."""
    return notebook(CODE, filled('"k":0,', MAX_NOTEBOOK - 200))


def lines() -> bytes:
    """A source in a million empty lines."""
    return notebook(f'{{"cell_type": "code", "source": [{filled(chr(34) * 2 + ",", 5 << 20)}""]}}')


def nesting() -> bytes:
    """Lists in lists, to the end of the file."""
    half = MAX_NOTEBOOK // 2 - 200
    return notebook(CODE, f'"k": {"[" * half}{"]" * half},')


def digits() -> bytes:
    """A number of ten million digits where a version, a count and a key are read."""
    number = "7" * 6_000_000
    cell = f'{{"cell_type": "code", "execution_count": {number}, "source": "x = 1"}}'
    return notebook(cell, f'"nbformat": {number}, "metadata": {{"slam1d": {{"variant": {number}}}}},')


def digits_in_a_source() -> bytes:
    """The same where a text is expected."""
    return notebook(f'{{"cell_type": "code", "source": {"7" * (5 << 20)}}},{CODE}')


def escapes() -> bytes:
    """Backslashes, and halves of surrogate pairs, as far as a file goes."""
    return notebook(f'{{"cell_type": "code", "source": "{chr(92) * (8 << 20)}{filled(chr(92) + "ud800", 8 << 20)}"}}')


def questions() -> bytes:
    """Markdown that nearly begins a question, again and again."""
    text = filled("#", 1 << 20) + "\n" + filled(" \n", 1 << 20) + filled("**Your answer to question 2** (", 1 << 20)
    return notebook(f"{markdown(text)},{markdown(filled(' ', 1 << 20))},{CODE}")


def module_of_cookies() -> bytes:
    """First lines that nearly declare an encoding, and half a megabyte of one line."""
    return b"#" + b"coding:" * 600 + b"\n#" + b" \t" * 2000 + b"coding:\n" + b"x = 1" * 100_000


def module_in_another_encoding() -> bytes:
    """Text in an encoding of many bytes a letter."""
    return b"# coding: gb18030\n" + b"\x81\x30\x81\x30" * ((MAX_SOURCE - 100) // 4)


def zeros() -> bytes:
    """A file of zero bytes."""
    return bytes(MAX_NOTEBOOK)


def directory() -> bytes:
    """An archive that is nothing but its table of contents."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as archive:
        for number in range(4_900):
            archive.writestr(f"{'a/' * 400}{number}", b"")
    return out.getvalue()[:MAX_ARCHIVE]


def directory_of_names() -> bytes:
    """Entries that are all candidates, with a megabyte each where they are unpacked."""
    out = io.BytesIO()
    body = b"def residual(x, graph):\n" + b" " * (1 << 20)
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for number in range(150):
            archive.writestr(f"{number}.py", body)
    return out.getvalue()


def unnamed() -> bytes:
    """Entries whose names say nothing, so that what is inside has to be looked at."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for number in range(150):
            archive.writestr(f"{number}.txt", b"def " * (1 << 18))
    return out.getvalue()


def bomb() -> bytes:
    """One entry that unpacks to more than is read."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive, archive.open("a.ipynb", "w") as file:
        for _ in range(64):
            file.write(bytes(1 << 20))
    return out.getvalue()


WORST: dict[str, tuple[str, Callable[[], bytes]]] = {
    make.__name__: (suffix, make)
    for suffix, makers in {
        ".ipynb": (
            attachments, attachments_that_are_named, media_types, chunks, cells, too_many_cells, keys, lines, nesting,
            digits, digits_in_a_source, escapes, questions, zeros,
        ),
        ".py": (module_of_cookies, module_in_another_encoding),
        ".zip": (directory, directory_of_names, unnamed, bomb),
    }.items()
    for make in makers
}  # fmt: skip
