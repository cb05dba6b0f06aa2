"""Zip archives, read without unpacking to disk: every entry is bounded by the bytes that really come out of it.

Names, sizes and kinds in an archive are claims of whoever made it. An entry that could mean harm elsewhere (a path
that leads out, a link, a device, two names that one file system would merge) condemns the archive, in one sentence.
"""

from __future__ import annotations

import io
import mmap
import re
import stat
import struct
import unicodedata
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from autograder.errors import RejectedUpload
from autograder.intake.naming import printable
from autograder.intake.tree import Entry, Tree, is_noise, sort_key

MAX_ARCHIVE = 20 << 20  # bytes of one student's archive
MAX_ENTRIES = 5_000
MAX_CLASS_ENTRIES = 50_000
MAX_PATH = 1_024
MAX_DEPTH = 24  # folders in each other
CHUNK = 1 << 16

_CENTRAL = b"PK\x01\x02"  # begins each line of the table of contents; there are no more entries than of these
_ARCHIVES = frozenset({".zip", ".tar", ".tgz", ".gz", ".bz2", ".xz", ".rar", ".7z", ".jar", ".whl", ".zst"})
_DRIVE = re.compile(r"[A-Za-z]:")
_METHODS = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)  # others may claim memory by the gigabyte
_BROKEN = (
    zipfile.BadZipFile, zipfile.LargeZipFile, zlib.error, struct.error, EOFError, OSError, RuntimeError,
    NotImplementedError, ValueError, LookupError, OverflowError, MemoryError,
)  # fmt: skip
_PACK_AGAIN = "pack the files again with an ordinary zip program"


def archive_tree(data: bytes) -> Tree:
    """List one student's archive; raises RejectedUpload with the end of a sentence where anything in it is odd."""
    if len(data) > MAX_ARCHIVE:
        raise RejectedUpload("is larger than 20 MiB; hand in the .py or .ipynb file alone")
    if not data.startswith(b"PK"):
        raise RejectedUpload(f"is no zip archive, whatever its name says; {_PACK_AGAIN}")
    if data.count(_CENTRAL) > MAX_ENTRIES:
        raise RejectedUpload(f"holds more than {MAX_ENTRIES} entries; hand in the .py or .ipynb file alone")
    tree = _tree(io.BytesIO(data), "archive", "archive")
    for entry in tree.entries:
        if entry.problem:
            raise RejectedUpload(f"holds an entry {printable(entry.name)[:80]!r} that {entry.problem}")
        if entry.suffix in _ARCHIVES:
            name = printable(entry.name)[:80]
            raise RejectedUpload(f"holds another archive ({name}); hand in the .py or .ipynb file")
    return tree


def class_archive_tree(path: Path) -> Tree:
    """List an archive of a whole class, such as an LMS exports; an odd entry is a problem of that entry alone.

    Raises RejectedUpload where the archive itself cannot be read.
    """
    with path.open("rb") as file:
        if file.read(2) != b"PK":
            raise RejectedUpload(f"is no zip archive, whatever its name says; {_PACK_AGAIN}")
        with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as mapped:
            if _more_than(mapped, _CENTRAL, MAX_CLASS_ENTRIES):
                raise RejectedUpload(f"holds more than {MAX_CLASS_ENTRIES} entries; unpack it and give the folder")
    return _tree(path, str(path.resolve()), path.stem)


def _tree(file: Path | io.BytesIO, origin: str, name: str) -> Tree:
    with _zip_errors():
        archive = zipfile.ZipFile(file)  # stays open as long as an entry can be loaded
        infos = archive.infolist()
    entries: list[Entry] = []
    folders: set[tuple[str, ...]] = set()
    taken: dict[str, bool] = {}
    for info in infos:
        parts, problem = _path(info)
        if info.orig_filename == "./":
            continue  # the folder that was packed itself
        is_folder = info.orig_filename.endswith(("/", "\\"))  # ZipInfo.is_dir fails where there is no name
        if not problem and (any(map(is_noise, parts[:-1])) or (is_noise(parts[-1]) and not is_folder)):
            folders.update(parts[: depth + 1] for depth in range(len(parts) - 1) if not parts[depth].startswith("__"))
            continue
        key = unicodedata.normalize("NFC", "/".join(parts)).casefold()
        if key in taken and not (is_folder and taken[key]):
            problem = problem or "stands there twice under names that some systems hold for one"
        taken[key] = is_folder
        folders.update(parts[: depth + 1] for depth in range(len(parts) - 1))
        if is_folder and not problem:
            folders.add(parts)
            continue
        load = partial(_load, archive, info)
        own_origin = f"{origin}!{info.header_offset}!{info.orig_filename}"
        entries.append(Entry(parts, own_origin, load, problem or _entry_problem(info)))
    entries.sort(key=lambda entry: sort_key(entry.parts))
    return Tree(name=name, entries=tuple(entries), folders=frozenset(folders), archive=True)


def _path(info: zipfile.ZipInfo) -> tuple[tuple[str, ...], str]:
    """Return the parts of an entry's path, and what is wrong with it."""
    written = info.orig_filename.replace("\\", "/")
    parts = tuple(part for part in written.split("/") if part not in ("", "."))
    if not parts:
        return ("entry",), "has no name"
    if len(written) > MAX_PATH:
        return (parts[-1][:80],), "has a name longer than any file system takes"
    if len(parts) > MAX_DEPTH:
        return (parts[-1],), f"lies more than {MAX_DEPTH} folders deep"
    if "\0" in written:
        return parts, "has a name with a zero byte in it"
    if written.startswith("/") or _DRIVE.match(written):
        return parts, "has an absolute path, expected one inside the archive"
    if ".." in parts:
        return parts, "has a path that leads out of the archive (..)"
    return parts, ""


def _entry_problem(info: zipfile.ZipInfo) -> str:
    kind = stat.S_IFMT(info.external_attr >> 16)
    if kind == stat.S_IFLNK:
        return "is a link; pack the file itself"
    if kind not in (0, stat.S_IFREG, stat.S_IFDIR):
        return "is a device, a pipe or the like; pack ordinary files only"
    if info.flag_bits & 0x2041:
        return "is encrypted; pack it without a password"
    if info.compress_type not in _METHODS:
        return f"is compressed in an unusual way (method {info.compress_type}); {_PACK_AGAIN}"
    return ""


def _load(archive: zipfile.ZipFile, info: zipfile.ZipInfo, limit: int) -> bytes:
    """Unpack at most ``limit + 1`` bytes of an entry into memory."""
    chunks: list[bytes] = []
    left = limit + 1
    with _zip_errors(), archive.open(info) as stream:
        while left and (chunk := stream.read(min(left, CHUNK))):
            chunks.append(chunk)
            left -= len(chunk)
    data = b"".join(chunks)
    if left and len(data) != info.file_size:
        raise RejectedUpload(f"is broken (it unpacks to another size than it claims); {_PACK_AGAIN}")
    return data


@contextmanager
def _zip_errors() -> Iterator[None]:
    try:
        yield
    except _BROKEN:
        raise RejectedUpload(f"is a broken or truncated zip archive; {_PACK_AGAIN}") from None


def _more_than(mapped: mmap.mmap, pattern: bytes, limit: int) -> bool:
    found, position = 0, mapped.find(pattern)
    while position >= 0 and found <= limit:
        found += 1
        position = mapped.find(pattern, position + len(pattern))
    return found > limit
