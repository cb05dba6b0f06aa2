"""Archives: one submission in a zip is read, and whatever could harm elsewhere condemns it in a sentence."""

from __future__ import annotations

import io
import random
import stat
import struct
import time
import tracemalloc
import zipfile
from pathlib import Path

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from autograder.errors import RejectedUpload
from autograder.intake.archive import MAX_ARCHIVE, MAX_ENTRIES, archive_tree, class_archive_tree
from autograder.intake.reading import Content, read_entry
from autograder.intake.tree import Entry
from tests.intake.making import CODE, archive, cell, info, notebook, write

GOOD = archive({"hw/slam1d.py": CODE, "__MACOSX/hw/._slam1d.py": "x", "hw/.DS_Store": "x", "hw/posegraph.py": ""})


def read(data: bytes) -> Content:
    """Read a student's archive as the engine does."""
    return read_entry(Entry(("alice.zip",), "alice.zip", lambda limit: data[: limit + 1]))


def rejection(data: bytes) -> str:
    """Return why the archive is rejected."""
    with pytest.raises(RejectedUpload) as raised:
        read(data)
    return str(raised.value)


def with_entry(header: zipfile.ZipInfo, content: bytes | str = CODE) -> bytes:
    """Return a good archive with one more entry, its header as given."""
    buffer = io.BytesIO(GOOD)
    with zipfile.ZipFile(buffer, "a") as target:
        target.writestr(header, content)
    return buffer.getvalue()


def test_an_archive_with_one_submission_is_that_submission() -> None:
    """Folders, noise and the provided files in it do not count."""
    content = read(GOOD)
    assert content.source.cells == [CODE]
    assert content.source.name == "slam1d.py"
    assert content.notes == ("Read from hw/slam1d.py in the archive.",)
    assert read(with_entry(info("./"), "")).source.cells == [CODE]
    assert read(with_entry(info(".venv/bin/python", stat.S_IFLNK | 0o777), "/usr/bin/python")).source.cells == [CODE]
    packed = read(archive({"a.ipynb": notebook(cell("a = 1"), cell("b = 2"))}, zipfile.ZIP_STORED))
    assert packed.source.cells == ["a = 1", "b = 2"]


def test_of_several_files_only_one_with_the_name_of_the_homework_is_taken() -> None:
    """Nothing is guessed, and what was left out is said."""
    assert read(archive({"slam1d.py": CODE, "old.py": "x"})).notes[1:] == (
        "Graded slam1d.py; also handed in and not graded: old.py.",
    )
    assert read(archive({"mine.py": CODE, "setup.py": "x", "test_mine.py": "x"})).source.name == "mine.py"
    assert rejection(archive({"a.py": CODE, "b.py": CODE})) == (
        "holds 2 submissions (a.py, b.py), expected one .py, .ipynb or .zip file; keep the one that counts; "
        "an archive of a whole class is unpacked first"
    )
    assert rejection(archive({"notes.txt": "x"})).startswith("holds no submission (found notes.txt), expected one")
    assert rejection(archive({})).startswith("holds no submission (found nothing)")
    assert rejection(archive({"posegraph.py": "x"})).startswith("holds only files that were handed out")


@pytest.mark.parametrize(
    ("header", "words"),
    [
        (info("../slam1d.py"), "has a path that leads out of the archive (..)"),
        (info("a/../../b.txt"), "has a path that leads out of the archive (..)"),
        (info("..\\b.txt"), "has a path that leads out of the archive (..)"),
        (info(".."), "has a path that leads out of the archive (..)"),
        (info("__MACOSX/../x"), "has a path that leads out of the archive (..)"),
        (info(""), "has no name"),
        (info("///"), "has no name"),
        (info("/etc/cron.d/x"), "has an absolute path, expected one inside the archive"),
        (info("\\\\server\\share"), "has an absolute path"),
        (info("C:\\x.py"), "has an absolute path"),
        (info("c:x.py"), "has an absolute path"),
        (info("HW/SLAM1D.PY"), "stands there twice under names that some systems hold for one"),
        (info("hw/slam1d.py"), "stands there twice"),
        (info("hw/./slam1d.py"), "stands there twice"),
        (info("hw/slam1d.py/"), "stands there twice"),
        (info("link.py", stat.S_IFLNK | 0o777), "is a link; pack the file itself"),
        (info("pipe", stat.S_IFIFO | 0o644), "is a device, a pipe or the like"),
        (info("null", stat.S_IFCHR | 0o644), "is a device, a pipe or the like"),
        (info("disk", stat.S_IFBLK | 0o644), "is a device, a pipe or the like"),
        (info("x" * 2000), "has a name longer than any file system takes"),
        (info("inner.zip"), "holds another archive (inner.zip)"),
        (info("inner.tar.gz"), "holds another archive (inner.tar.gz)"),
    ],
)
@pytest.mark.filterwarnings("ignore:Duplicate name")
def test_an_entry_that_could_do_harm_condemns_the_archive(header: zipfile.ZipInfo, words: str) -> None:
    """Also where the submission beside it would be in order."""
    assert words in rejection(with_entry(header))


def test_a_composed_and_a_decomposed_name_collide() -> None:
    """One file system keeps both, another only the last."""
    assert "stands there twice" in rejection(archive({"u\u0308.txt": "x", "\u00fc.txt": "y", "slam1d.py": CODE}))


def test_a_zero_byte_in_a_name_is_seen() -> None:
    """The reader of the standard library cuts the name there."""
    data = archive({"slam1d.py@.txt": CODE}).replace(b"slam1d.py@", b"slam1d.py\0")
    assert "has a name with a zero byte in it" in rejection(data)


def test_an_encrypted_entry_is_said() -> None:
    """The flag alone decides; nobody is asked for a password."""
    data = bytearray(archive({"slam1d.py": CODE}))
    data[6] |= 1
    data[data.index(b"PK\x01\x02") + 8] |= 1
    assert "is encrypted; pack it without a password" in rejection(bytes(data))


@pytest.mark.parametrize("method", [zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA])
def test_methods_that_claim_much_memory_are_refused(method: int) -> None:
    """Only stored and deflated entries are unpacked."""
    assert f"is compressed in an unusual way (method {method})" in rejection(archive({"slam1d.py": CODE}, method))


def test_a_bomb_is_judged_by_the_bytes_that_come_out() -> None:
    """A gigabyte of zeros in a megabyte is stopped at the limit, in little time and memory."""
    zeros = io.BytesIO()
    with zipfile.ZipFile(zeros, "w", zipfile.ZIP_DEFLATED) as target, target.open("slam1d.py", "w") as entry:
        for _ in range(64):
            entry.write(bytes(1 << 20))
    started = time.monotonic()
    tracemalloc.start()
    words = rejection(zeros.getvalue())
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert words == "holds slam1d.py, which is larger than 1 MiB, the limit for a .py file; remove data from the source"
    assert peak < 80 << 20
    assert time.monotonic() - started < 5


@pytest.mark.parametrize("claim", [1, 10, 1 << 31])
def test_a_size_that_lies_is_found_out(claim: int) -> None:
    """Whether it claims too little or too much, what comes out is not what the header says."""
    data = bytearray(archive({"slam1d.py": CODE * 50}))
    struct.pack_into("<I", data, 22, claim)
    struct.pack_into("<I", data, data.index(b"PK\x01\x02") + 24, claim)
    assert "broken" in rejection(bytes(data))


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "is no zip archive, whatever its name says"),
        (b"Rar!\x1a\x07", "is no zip archive"),
        (b"#!/bin/sh\n" + GOOD, "is no zip archive"),
        (GOOD[: len(GOOD) // 2], "is a broken or truncated zip archive"),
        (GOOD[:-4], "is a broken or truncated zip archive"),
        (b"PK\x03\x04" + bytes(100), "is a broken or truncated zip archive"),
        (b"PK" + bytes(MAX_ARCHIVE), "is larger than 20 MiB"),
        (b"PK\x01\x02" * (MAX_ENTRIES + 1), "holds more than 5000 entries"),
    ],
)
def test_what_is_no_archive_is_said(data: bytes, words: str) -> None:
    """Truncated, prefixed, oversized and overfull archives each have their sentence."""
    assert words in rejection(data)


def test_a_wrong_checksum_is_found() -> None:
    """Damage in transit is not graded."""
    data = bytearray(archive({"slam1d.py": CODE}, zipfile.ZIP_STORED))
    at = data.index(b"residual")
    data[at] ^= 1
    assert rejection(bytes(data)).startswith("holds slam1d.py, which is a broken or truncated zip archive")


def test_in_an_archive_of_a_class_a_bad_entry_is_bad_alone(tmp_path: Path) -> None:
    """One student's link does not cost the others their marks."""
    buffer = io.BytesIO(archive({"alice/slam1d.py": CODE}))
    with zipfile.ZipFile(buffer, "a") as target:
        target.writestr(info("bob/slam1d.py", stat.S_IFLNK | 0o777), "../alice/slam1d.py")
    path = write(tmp_path, {"class.zip": buffer.getvalue()}) / "class.zip"
    alice, bob = class_archive_tree(path).entries
    assert (alice.problem, bob.problem) == ("", "is a link; pack the file itself")
    assert alice.load(1 << 20) == CODE.encode()


@example(b"\1\1\1", 273, 3)  # a name that cannot be printed, in front of data that cannot be read
@given(st.binary(max_size=200), st.integers(0, len(GOOD)), st.integers(0, 60))
def test_random_bytes_are_read_or_rejected(noise: bytes, at: int, dropped: int) -> None:
    """No error but our own comes out, wherever the bytes are put."""
    for data in (noise, b"PK" + noise, GOOD[:at] + noise + GOOD[at + dropped :]):
        try:
            assert read(data).source.cells
        except RejectedUpload as error:
            assert str(error).isprintable()  # noqa: PT017 (either outcome is right)


def test_mutated_archives_are_read_or_rejected() -> None:
    """Every byte of the table of contents is changed to the values that hurt most."""
    draw = random.Random(2)
    rejected = 0
    table = GOOD.index(b"PK\x01\x02")
    for _ in range(1200):
        mutant = bytearray(GOOD)
        for _ in range(draw.randint(1, 3)):
            at = draw.randrange(table if draw.random() < 0.7 else 0, len(mutant))
            mutant[at] = draw.choice([0, 1, 8, 12, 127, 128, 255, draw.randrange(256)])
        try:
            archive_tree(bytes(mutant))
            read(bytes(mutant))
        except RejectedUpload:
            rejected += 1
    assert 200 < rejected < 1200
