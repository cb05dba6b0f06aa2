"""Reads what a numpydoc docstring promises: the names, types and shapes of arguments and results."""

from __future__ import annotations

import inspect
import re
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Entry:
    """One line of a Parameters or Returns section, with the text below it."""

    name: str
    type: str
    text: str

    @property
    def shape(self) -> tuple[str, ...] | None:
        """Letters of the promised shape, as in `(m, n) float array`; None where no shape is promised."""
        found = re.match(r"\(([\w, ]*)\)", self.type)
        return tuple(part.strip() for part in found[1].split(",") if part.strip()) if found else None


def sections(function: Any) -> dict[str, str]:
    """Split a docstring at its underlined titles; the text before the first one is under ""."""
    text = inspect.cleandoc(function.__doc__ or "")
    pieces = re.split(r"^(\w[\w ]*)\n-{3,}\n", text, flags=re.MULTILINE)
    return {"": pieces[0]} | dict(zip(pieces[1::2], pieces[2::2], strict=True))


def entries(function: Any, section: str) -> list[Entry]:
    """Read a section of entries: a line `name : type` or `type`, then indented text."""
    found = re.findall(r"^(\S.*)\n((?:[ ]+.*\n?|\n)*)", sections(function).get(section, "") + "\n", flags=re.MULTILINE)
    read = []
    for head, body in found:
        name, colon, kind = head.partition(" : ")
        read.append(Entry(name if colon else "", kind if colon else head, inspect.cleandoc(body)))
    return read
