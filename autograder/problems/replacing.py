"""Files and folders that appear whole or not at all."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Mapping
from pathlib import Path

from autograder.writing import make_private, write_whole

__all__ = ["UNFINISHED", "replace_file", "replace_folder"]

UNFINISHED = ".unfinished-"  # names that begin like this were left by a run that was killed


def replace_file(path: Path, data: bytes, *, lasting: bool = False) -> None:
    """Write a file beside its place, then move it there; only its owner may read it.

    Parameters
    ----------
    path : Path
        Its place; missing folders are made.
    data : bytes
        What it shall hold.
    lasting : bool
        Whether it must also be there whole when the power fails.
    """
    make_private(path.parent)
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=UNFINISHED)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
            if lasting:
                file.flush()
                os.fsync(file.fileno())
        Path(name).replace(path)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise


def replace_folder(folder: Path, files: Mapping[str, bytes]) -> None:
    """Write a folder beside its place, then move it there; what stood there before is gone."""
    make_private(folder.parent)
    beside = Path(tempfile.mkdtemp(dir=folder.parent, prefix=UNFINISHED))
    for name, data in files.items():
        make_private((beside / name).parent)
        write_whole(beside / name, data)
    if folder.exists():
        old = Path(tempfile.mkdtemp(dir=folder.parent, prefix=UNFINISHED))
        folder.replace(old / folder.name)
        beside.replace(folder)
        shutil.rmtree(old)
    else:
        beside.replace(folder)
