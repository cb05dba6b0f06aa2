"""Names of submissions: safe as file names on every system, distinct in one run, the same in every run."""

from __future__ import annotations

import hashlib
import unicodedata
from collections import Counter
from collections.abc import Sequence

MAX_BYTES = 120  # leaves room for suffixes and for temporary names below the 255 bytes of most file systems
_PUNCTUATION = frozenset(" -_.,()+@")
_RESERVED = {"con", "prn", "aux", "nul", *(f"{port}{digit}" for port in ("com", "lpt") for digit in "0123456789")}


def safe_name(text: str) -> str:
    """Turn any text into a name that is safe as a file name, as a CSV cell and as an argument.

    Letters and digits of every script stay; whatever else could mean something to a file system, a shell or a
    spreadsheet becomes "_". It never starts with a dot, a dash or a blank.

    Examples
    --------
    >>> safe_name("Zoë Müller_17"), safe_name("../../etc/passwd"), safe_name("=cmd|x"), safe_name("con")
    ('Zoë Müller_17', '_.._etc_passwd', '_cmd_x', '_con')
    """
    normal = unicodedata.normalize("NFC", text)
    kept = "".join(char if _is_kept(char) else "_" for char in normal)
    kept = kept.lstrip(" .-+@").rstrip(" .")
    if kept.split(".")[0].strip().casefold() in _RESERVED:
        kept = f"_{kept}"  # names of devices on Windows
    if not kept.strip("_.,()+@- "):
        kept = "submission"
    return shorten(kept)


def shorten(name: str) -> str:
    """Cut a name to `MAX_BYTES` bytes; what was cut away still counts, as eight digits of a hash."""
    if len(name.encode()) <= MAX_BYTES:
        return name
    mark = "-" + hashlib.sha256(name.encode()).hexdigest()[:8]
    head = name.encode()[: MAX_BYTES - len(mark)].decode(errors="ignore")
    return head.rstrip(" .") + mark


def distinct_names(wanted: Sequence[tuple[str, str]]) -> list[str]:
    """Give each of (name, folder it came from) a safe name of its own, without regard to case.

    Those that would have the same name are told apart by their folders where these differ, otherwise by a number.

    Examples
    --------
    >>> distinct_names([("hw", "a"), ("HW", "b"), ("alice", "a"), ("bob", ""), ("bob", "")])
    ['a-hw', 'b-HW', 'alice', 'bob', 'bob-2']
    """
    names = [safe_name(name) for name, _ in wanted]
    count = Counter(_fold(name) for name in names)
    prefixed = [shorten(safe_name(f"{folder}-{name}")) for (_, folder), name in zip(wanted, names, strict=True)]
    prefix_count = Counter(_fold(name) for name in prefixed)
    chosen: list[str] = []
    taken = {fold for fold, times in count.items() if times == 1}
    for name, long_name, (_, folder) in zip(names, prefixed, wanted, strict=True):
        if count[_fold(name)] == 1:
            chosen.append(name)
            continue
        free = long_name if folder and prefix_count[_fold(long_name)] == 1 else name
        number = 1
        base = free
        while _fold(free) in taken:
            number += 1
            free = f"{base}-{number}"
        taken.add(_fold(free))
        chosen.append(free)
    return chosen


def printable(text: str) -> str:
    """Return text that is safe to show on a terminal and to encode: one line, control characters replaced."""
    return "".join(char if char.isprintable() else "\N{REPLACEMENT CHARACTER}" for char in text)[:300]


def _is_kept(char: str) -> bool:
    return char in _PUNCTUATION or unicodedata.category(char)[0] in "LMN"


def _fold(name: str) -> str:
    return unicodedata.normalize("NFKC", unicodedata.normalize("NFKC", name).casefold())
