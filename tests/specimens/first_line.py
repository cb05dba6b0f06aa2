"""Reads and executes trusted specimens; what a first line means is known to the audit."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import nbformat
import numpy as np

import autograder
from autograder.audit.expectation import Expected, expected

__all__ = ["SPECIMENS", "Expected", "code", "executed", "expected", "submissions"]

SPECIMENS = Path(autograder.__file__).parent / "specimens"


def code(path: Path) -> list[str]:
    """Return the code of a specimen, a text a cell; a module is one cell."""
    if path.suffix == ".py":
        return [path.read_text("utf-8")]
    notebook = nbformat.read(path, as_version=4)  # type: ignore[no-untyped-call]  # it has no annotations
    return [cell.source for cell in notebook.cells if cell.cell_type == "code"]


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
