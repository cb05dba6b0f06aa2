"""Notebooks from one readable template: `%% kind name` opens a cell, its name becomes the cell's id."""

from __future__ import annotations

import json
import re
import textwrap
from collections.abc import Mapping
from functools import lru_cache
from typing import Any

import nbformat

from autograder.render.template import fill

__all__ = ["build_notebook", "render_notebook"]

_HEAD = re.compile(r"^%% (markdown|code|provided) ([a-z0-9][a-z0-9-]*)\n", re.MULTILINE)

# Jupyter and VS Code fold the source of a provided cell, Colab shows it as a form, nbconvert can go by the tag.
_FOLDED = {"cellView": "form", "jupyter": {"source_hidden": True}, "tags": ["hide-input"]}
_KERNEL = {
    "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
    "language_info": {"name": "python"},
}
_FORMAT = {"nbformat": 4, "nbformat_minor": 5}


def render_notebook(template: str, metadata: Mapping[str, Any] | None = None, **values: Any) -> str:
    """Fill a template and return the notebook as the text of an .ipynb file (nbformat 4.5).

    Parameters
    ----------
    template : str
        Name of the template.
    metadata : mapping, optional
        What its metadata say beside the kernel.
    **values
        What the template names.
    """
    # A class is a thousand notebooks. Validating one takes longer than all the rest, so tests validate instead;
    # and most cells are the same in all of them, so each is written once.
    cells = ",\n".join(_cell_text(*part) for part in _parts(fill(template, **values)))
    empty = {"cells": [], "metadata": {**_KERNEL, **(metadata or {})}, **_FORMAT}
    return _json(empty).replace('"cells": []', f'"cells": [\n{cells}\n ]', 1) + "\n"


def build_notebook(text: str) -> nbformat.NotebookNode:
    r"""Build a notebook from the text of its cells, and validate it.

    Parameters
    ----------
    text : str
        Cells one after the other, each opened by a line `%% kind name`. Kinds: markdown, code, and
        provided, a code cell that is shown folded.

    Returns
    -------
    NotebookNode
        Valid nbformat 4.5, no outputs, for the kernel python3.

    Raises
    ------
    ValueError
        Where text stands before the first cell or two cells have one name.

    Examples
    --------
    >>> notebook = build_notebook("%% markdown title\n# Words\n\n%% code sum\n1 + 1\n")
    >>> [(cell.id, cell.source) for cell in notebook.cells]
    [('title', '# Words'), ('sum', '1 + 1')]
    """
    content = {"cells": [_cell(*part) for part in _parts(text)], "metadata": _KERNEL, **_FORMAT}
    notebook: nbformat.NotebookNode = nbformat.from_dict(content)  # type: ignore[no-untyped-call]  # nbformat has no types
    for cell in notebook.cells:
        cell.source = "".join(cell.source)
    nbformat.validate(notebook)
    return notebook


def _parts(text: str) -> list[tuple[str, str, str]]:
    """Split the text of cells: kind, name and source of each."""
    before, *parts = _HEAD.split(text)
    stray = [line for part in parts[2::3] for line in part.splitlines() if line.startswith("%% ")]
    if stray:
        raise ValueError(f"a head must read `%% kind name`, the name in small letters and dashes, got {stray[0]!r}")
    if before.strip():
        raise ValueError(f"a template must begin with a line `%% kind name`, got {before.strip()[:40]!r}")
    names = parts[1::3]
    twice = {name for name in names if names.count(name) > 1}
    if twice:
        raise ValueError(f"every cell must have a name of its own, got {sorted(twice)} more than once")
    return list(zip(parts[0::3], names, parts[2::3], strict=True))


@lru_cache(maxsize=256)
def _cell_text(kind: str, name: str, source: str) -> str:
    """Write a cell as it stands in a file."""
    return textwrap.indent(_json(_cell(kind, name, source)), "  ")


def _json(content: Any) -> str:
    return json.dumps(content, sort_keys=True, indent=1, ensure_ascii=False, separators=(",", ": "))


def _cell(kind: str, name: str, source: str) -> dict[str, Any]:
    cell = {
        "cell_type": "markdown" if kind == "markdown" else "code",
        "id": name,
        "metadata": _FOLDED if kind == "provided" else {},
        "source": source.strip("\n").splitlines(keepends=True),
    }
    return cell if kind == "markdown" else cell | {"execution_count": None, "outputs": []}
