"""Zip archives that are the same bytes for the same content."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Mapping

from autograder.errors import UsageError

_DATE = (1980, 1, 1, 0, 0, 0)


def bundle(files: Mapping[str, bytes], executable: frozenset[str] = frozenset()) -> bytes:
    """Pack files in the order of their names; those that are named may be run.

    Examples
    --------
    >>> data = bundle({"run": b"#!/bin/sh", "a/b.txt": b"x"}, frozenset({"run"}))
    >>> [(info.filename, oct(info.external_attr >> 16)) for info in zipfile.ZipFile(io.BytesIO(data)).infolist()]
    [('a/b.txt', '0o100644'), ('run', '0o100755')]
    """
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in sorted(files.items()):
            info = zipfile.ZipInfo(name, _DATE)
            info.create_system = 3  # Unix: or the modes below mean nothing
            info.external_attr = (0o100755 if name in executable else 0o100644) << 16
            info.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(info, data)
    return buffer.getvalue()


def names_in(data: bytes, name: str) -> list[str]:
    """List the files of an archive; nothing is unpacked.

    Raises
    ------
    UsageError
        Where it is no whole zip archive.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            return [info.filename for info in archive.infolist() if not info.is_dir()]
    except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError):
        raise UsageError(f"{name} is no whole zip archive; was the download cut short? Download it again.") from None
