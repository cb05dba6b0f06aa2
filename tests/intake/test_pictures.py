"""Pictures in written answers: small and whole ones are kept, without what a camera or an attacker adds."""

from __future__ import annotations

import base64
import json
import time
import zlib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.intake.notebook import read_notebook
from autograder.intake.pictures import MAX_PICTURE, cleaned


def chunk(kind: bytes, body: bytes) -> bytes:
    """Write one chunk of a PNG."""
    return len(body).to_bytes(4, "big") + kind + body + zlib.crc32(kind + body).to_bytes(4, "big")


def png(*extra: bytes, wide: int = 1) -> bytes:
    """Write a PNG of one grey pixel."""
    head = wide.to_bytes(4, "big") + (1).to_bytes(4, "big") + b"\x08\x00\x00\x00\x00"
    parts = [chunk(b"IHDR", head), *extra, chunk(b"IDAT", zlib.compress(b"\x00\x80")), chunk(b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(parts)


def jpeg(*extra: bytes) -> bytes:
    """Write the frame of a JPEG; enough for what is looked at."""
    size = b"\xff\xc0\x00\x0b\x08\x00\x01\x00\x01\x01\x01\x11\x00"
    return (
        b"\xff\xd8" + b"".join(extra) + size + b"\xff\xda\x00\x08\x01\x01\x00\x00\x3f\x00" + b"\x12\x34" + b"\xff\xd9"
    )


def notebook(*cells: tuple[str, dict[str, dict[str, str]]]) -> bytes:
    """Write a notebook of markdown cells with attachments."""
    written = [{"cell_type": "markdown", "metadata": {}, "source": s, "attachments": a} for s, a in cells]
    code = {"cell_type": "code", "metadata": {}, "source": "x = 1", "outputs": [], "execution_count": None}
    return json.dumps({"cells": [*written, code], "metadata": {}, "nbformat": 4, "nbformat_minor": 5}).encode()


def encoded(data: bytes) -> str:
    """Write bytes as Jupyter does."""
    return base64.b64encode(data).decode()


def test_a_png_loses_its_text_and_what_stands_behind_it() -> None:
    """What is kept is what a picture needs."""
    found = cleaned(png(chunk(b"tEXt", b"Author\0Jane")) + b"<script>")
    assert found == ("png", png())


def test_a_jpeg_loses_where_it_was_taken() -> None:
    """Segments of applications and comments go."""
    exif = b"\xff\xe1\x00\x08Exif\0\0"
    comment = b"\xff\xfe\x00\x06Jane"
    assert cleaned(jpeg(exif, comment) + b"trailer") == ("jpeg", jpeg())


@pytest.mark.parametrize(
    "data",
    [b"", b"GIF89a", b"<svg onload='alert(1)'>", png()[:-6], png(wide=100_000), b"\xff\xd8\xff", jpeg()[:-2],
     png().replace(b"IDAT", b"IDAX"), b"\x89PNG\r\n\x1a\n" + b"0" * MAX_PICTURE],
)  # fmt: skip
def test_anything_else_is_no_picture(data: bytes) -> None:
    """Other kinds, broken and too large ones are left out."""
    assert cleaned(data) is None


@given(st.binary(max_size=200), st.sampled_from([b"", b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff"]))
def test_no_bytes_are_an_error(data: bytes, start: bytes) -> None:
    """Whatever comes is a picture or none."""
    cleaned(start + data)


def test_two_cells_may_call_different_pictures_by_the_same_name() -> None:
    """Jupyter calls every pasted picture image.png; here each is called by its content."""
    one, two = png(), jpeg()
    read = read_notebook(
        notebook(
            ("![a](attachment:image.png)", {"image.png": {"image/png": encoded(one)}}),
            ("![b](attachment:image.png)", {"image.png": {"image/jpeg": encoded(two)}}),
        )
    )
    names = [text.partition("attachment:")[2].rstrip(")") for text in read.markdown]
    assert [read.pictures[name] for name in names] == [
        f"data:image/png;base64,{encoded(one)}",
        f"data:image/jpeg;base64,{encoded(two)}",
    ]


@pytest.mark.parametrize(
    "attached", [{"image.png": {"image/png": "%%%"}}, {"other.png": {"image/png": encoded(png())}}, 7]
)
def test_odd_attachments_leave_the_text_as_it_is(attached: object) -> None:
    """A picture that cannot be shown is a name in the text."""
    read = read_notebook(notebook(("see ![a](attachment:image.png)", attached)))  # type: ignore[arg-type] - that is the test
    assert read.markdown == ("see ![a](attachment:image.png)",)
    assert read.pictures == {}


def test_many_attachments_named_many_times_are_read_in_one_pass() -> None:
    """Neither their number nor how often a cell names one is multiplied with the other."""
    few, many = (notebook(("attachment:zzzzz " * (n // 2), {f"{k}": {} for k in range(n)})) for n in (20_000, 400_000))
    spent = []
    for data in (few, many):
        began = time.process_time()
        read_notebook(data)
        spent.append(time.process_time() - began)
    assert spent[1] < 2.0
    assert spent[1] < 100 * max(spent[0], 0.005)
