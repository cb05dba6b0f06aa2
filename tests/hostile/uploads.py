"""Builds the hostile uploads that are no text: archives, deep JSON, zero bytes, deep expressions, odd names.

Each has its number in the list of attacks. `refused` holds words of the reason, or is empty where
the upload is graded on what it honestly holds.
"""

from __future__ import annotations

import io
import stat
import struct
import tarfile
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass

from tests.intake.making import archive, cell, info, notebook

HONEST = """import numpy as np


def residual(x, graph):
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])
"""
WRONG = "\n\ndef information_matrix(graph):\n    return "


@dataclass(frozen=True)
class Upload:
    """One upload, the number of the attack, and the reason why it is refused."""

    number: int
    name: str
    data: bytes
    refused: str = ""
    called: str = ""

    @property
    def result(self) -> str:
        """The name of its result: the file's stem, where that is a plain one."""
        return self.called or self.name.rpartition(".")[0]


def uploads() -> Iterator[Upload]:
    """Build all of them; the bytes are the same every time."""
    good = {"slam1d.py": HONEST}
    yield Upload(33, "u33_start_up_files.zip", archive({**good, **dict.fromkeys(_START_UP, _TAKE_OVER)}))
    yield Upload(34, "u34_modules_of_that_name.zip", archive({**good, **dict.fromkeys(_MODULES, _TAKE_OVER)}))
    out = {"up": "../slam1d-hostile-88", "absolute": "/tmp/slam1d-hostile-88", "drive": "C:\\slam1d-hostile-88"}
    for word, name in out.items():
        reason = "leads out" if word == "up" else "absolute path"
        yield Upload(88, f"u88_path_{word}.zip", _with(info(name), b"x"), reason)
    kinds = {"link": stat.S_IFLNK, "device": stat.S_IFCHR, "pipe": stat.S_IFIFO}
    for word, kind in kinds.items():
        reason = "is a link" if word == "link" else "is a device, a pipe or the like"
        yield Upload(89, f"u89_entry_{word}.zip", _with(info("notes.txt", kind | 0o777), b"/etc/passwd"), reason)
    yield Upload(89, "u89_links.tar", _tar(), "is a tar archive; pack it as .zip")
    yield Upload(90, "u90_bomb.zip", _bomb(), "larger than 1 MiB")
    yield Upload(90, "u90_nested.zip", archive({**good, "inner.zip": archive(good)}), "holds another archive")
    yield Upload(90, "u90_lying_size.zip", _lying(), "broken")
    yield Upload(91, "u91_same_name.zip", _with(info("SLAM1D.PY"), HONEST.encode()), "stands there twice")
    deep = b"[" * 100_000 + b"]" * 100_000
    yield Upload(94, "u94_deep.ipynb", b'{"cells": ' + deep + b"}", "is JSON but no notebook")
    yield Upload(94, "u94_deep_output.ipynb", b'{"metadata": ' + deep + b', "cells": []}', "nested too deeply")
    yield Upload(94, "u94_not_a_number.ipynb", b'{"nbformat": NaN, "cells": []}', "is no valid JSON")
    yield Upload(94, "u94_huge_numbers.ipynb", notebook(cell(HONEST, execution_count=10**4000), nbformat=10**4000))
    for word, text in _DEEP.items():
        yield Upload(96, f"u96_deep_{word}.py", (HONEST + WRONG + text + "\n").encode())
        yield Upload(96, f"u96_deep_{word}_cell.ipynb", notebook(cell(HONEST), cell((WRONG + text).strip())))
    yield Upload(96, "u96_zero_bytes.py", HONEST.encode() + b"\0", "zero bytes")
    yield Upload(96, "u96_coding_cookie.py", b"# coding: zlib_codec\n" + HONEST.encode(), "which is not read")
    for name, called in _NAMES.items():
        yield Upload(101, f"{name}.py", HONEST.encode(), called=called)


_DEEP = {  # 200,000 operators, one below the other
    "minus": "-" * 200_000 + "1",
    "plus": "1" + "+1" * 200_000,
    "brackets": "(" * 200_000 + ")" * 200_000,
    "lists": "[" * 200_000 + "]" * 200_000,
    "calls": "f" + "()" * 200_000,
    "not": "not " * 200_000 + "x",
    "lambda": "lambda: " * 100_000 + "1",
    "attributes": "x" + ".a" * 200_000,
}
_NAMES = {
    "=HYPERLINK(1+1)": "_HYPERLINK(1+1)",
    "-rf <script>alert(1)<": "rf _script_alert(1)_",
    "u101\x1b[31m\u202e": "u101__31m_",
}
_START_UP = ("conftest.py", "sitecustomize.py", "usercustomize.py", "setup.py", "x.pth", "pytest.ini")
_MODULES = ("numpy.py", "random.py", "posegraph.py", "msgspec/__init__.py", "autograder/__init__.py")
_TAKE_OVER = "import os\nos.system('touch /tmp/slam1d-hostile-34')\n"


def _with(header: zipfile.ZipInfo, content: bytes) -> bytes:
    buffer = io.BytesIO(archive({"slam1d.py": HONEST}))
    with zipfile.ZipFile(buffer, "a") as target:
        target.writestr(header, content)
    return buffer.getvalue()


def _tar() -> bytes:
    """Pack a symbolic and a hard link and a device with a submission, as only tar can."""
    buffer = io.BytesIO()
    with tarfile.open(fileobj=buffer, mode="w") as target:
        for name, kind in (("a", tarfile.SYMTYPE), ("b", tarfile.LNKTYPE), ("c", tarfile.CHRTYPE)):
            member = tarfile.TarInfo(name)
            member.type, member.linkname = kind, "/etc/passwd"
            target.addfile(member)
        member = tarfile.TarInfo("slam1d.py")
        member.size = len(HONEST)
        target.addfile(member, io.BytesIO(HONEST.encode()))
    return buffer.getvalue()


def _bomb() -> bytes:
    """Pack 256 MiB of blanks into a quarter of a megabyte."""
    buffer = io.BytesIO()
    with (
        zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as target,
        target.open(_deflated("slam1d.py"), "w") as entry,
    ):
        for _ in range(256):
            entry.write(b" " * (1 << 20))
    return buffer.getvalue()


def _deflated(name: str) -> zipfile.ZipInfo:
    header = info(name)
    header.compress_type = zipfile.ZIP_DEFLATED
    return header


def _lying() -> bytes:
    """Let both headers claim one byte for an entry of many."""
    data = bytearray(archive({"slam1d.py": HONEST * 50}))
    struct.pack_into("<I", data, 22, 1)
    struct.pack_into("<I", data, data.index(b"PK\x01\x02") + 24, 1)
    return bytes(data)
