"""Reads specimens: their code, and the verdict that their first line states."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import nbformat
import numpy as np

import autograder

SPECIMENS = Path(autograder.__file__).parent / "specimens"
CLAUSE = re.compile(r"(?P<key>[a-z0-9_]+)=(?P<value>[a-z0-9_]+)(?::(?P<slip>[a-z0-9_]+))?(?P<share>\+follow_through)?")
LINE = re.compile(r"# expect: (?P<clauses>[^;]+); (?P<sentence>[^;]+\.)")


@dataclass(frozen=True)
class Expected:
    """The verdict in a first line; `stages` maps a stage to status, slip ("" for none) and follow-through."""

    stages: dict[str, tuple[str, str, bool]]
    others: str
    remarks: tuple[str, ...]
    sentence: str

    def status(self, stage: str) -> str:
        """Return the expected status of a stage."""
        return self.stages.get(stage, (self.others, "", False))[0]


def code(path: Path) -> list[str]:
    """Return the code of a specimen, a text a cell; a module is one cell."""
    if path.suffix == ".py":
        return [path.read_text("utf-8")]
    notebook = nbformat.read(path, as_version=4)  # type: ignore[no-untyped-call]  # it has no annotations
    return [cell.source for cell in notebook.cells if cell.cell_type == "code"]


def expected(line: str) -> Expected:
    """Read a first line; ValueError where it breaks the form of specimens/README.md."""
    match = LINE.fullmatch(line)
    clauses = [CLAUSE.fullmatch(text) for text in match["clauses"].split(" ")] if match else []
    if match is None or None in clauses:
        raise ValueError(f"got {line!r}, expected '# expect: <clause> [<clause> ...]; <sentence>.'")
    found = [
        (clause["key"], clause["value"], clause["slip"] or "", bool(clause["share"])) for clause in clauses if clause
    ]
    others = [value for key, value, _, _ in found if key == "others"]
    if len(others) != 1:
        raise ValueError(f"got {line!r}, expected exactly one clause 'others=<status>'")
    return Expected(
        stages={key: (value, slip, share) for key, value, slip, share in found if key not in ("others", "remark")},
        others=others[0],
        remarks=tuple(value for key, value, _, _ in found if key == "remark"),
        sentence=match["sentence"],
    )


def submissions(*folders: str) -> list[Path]:
    """List the files of some folders of specimens."""
    return sorted(
        path for name in folders for path in (SPECIMENS / name).glob("*.*") if path.suffix in (".py", ".ipynb")
    )


def executed(path: Path) -> dict[str, Any]:
    """Execute a trusted specimen and return what it defines."""
    namespace: dict[str, Any] = {"__name__": "slam1d", "np": np}
    for number, text in enumerate(code(path)):
        exec(compile(text, f"{path.name}[{number}]", "exec"), namespace)
    return namespace
