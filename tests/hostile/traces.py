"""Looks for what a hostile specimen tries to leave on the machine, all of it under one name or key."""

from __future__ import annotations

import ctypes
import os
import tempfile
from pathlib import Path

from tests.hostile.corpus import PREFIX

KEY = 0x51A1D079  # of the System V objects
_PLACES = ("/tmp", "/dev/shm", "/", "/var/tmp", "/dev/mqueue")


def found(*more: Path) -> list[str]:
    """Name every file, object, queue and key that is there; nothing where nothing was left."""
    return [*_files(more), *_objects(), *_queues(), *_keys(), *_sockets()]


def _files(more: tuple[Path, ...]) -> list[str]:
    places = {*map(Path, _PLACES), Path.home(), Path.cwd(), Path(tempfile.gettempdir()), *more}
    return [
        str(path)
        for place in sorted(places)
        if place.is_dir()
        for path in sorted(place.iterdir())
        if path.name.startswith(PREFIX)
    ]


def _objects() -> list[str]:
    """Look through shared memory, queues and semaphores of System V; their keys are printed signed."""
    signed = ctypes.c_int32(KEY).value
    return [
        f"System V {kind} {KEY:#x}"
        for kind in ("shm", "msg", "sem")
        for line in _lines(f"/proc/sysvipc/{kind}")[1:]
        if int(line.split()[0]) in (KEY, signed)
    ]


def _queues() -> list[str]:
    library = ctypes.CDLL(None, use_errno=True)
    if not hasattr(library, "mq_open"):
        return []
    number = library.mq_open(f"/{PREFIX}-79".encode(), os.O_RDONLY)
    if number >= 0:
        os.close(number)
    return [f"message queue /{PREFIX}-79"] if number >= 0 else []


def _keys() -> list[str]:
    return [line for line in _lines("/proc/keys") if PREFIX in line]


def _sockets() -> list[str]:
    return [line for line in _lines("/proc/net/unix") if PREFIX in line]


def _lines(path: str) -> list[str]:
    try:
        return Path(path).read_text("utf-8", "replace").splitlines()
    except OSError:
        return []
