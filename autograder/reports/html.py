"""HTML pages: self-contained, readable without a script, with everything foreign escaped.

The policy in each page lets nothing be loaded and nothing be sent: the style and the script are named
by their hashes, pictures are data.
"""

from __future__ import annotations

import base64
import contextlib
import hashlib
import sys
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemBytecodeCache, PackageLoader, StrictUndefined
from jinja2.bccache import Bucket
from markupsafe import Markup

from autograder.reports import charts
from autograder.reports.wording import number, outcome, plural, points, visible

_TEMPLATES = "reports/templates"


def page(template: str, **values: Any) -> str:
    """Fill a template; a value that is missing is an error, never an empty place."""
    return _environment().get_template(template).render(**values)


def picture(svg: str, description: str) -> Markup:
    """Embed an SVG as an image: nothing in it can run, and its ids are its own."""
    data = base64.b64encode(svg.encode()).decode()
    return Markup('<img src="data:image/svg+xml;base64,{}" alt="{}">').format(data, description)


class _Compiled(FileSystemBytecodeCache):
    """Compiled templates, kept beside their sources as Python keeps its modules, where that is allowed."""

    def __init__(self) -> None:
        super().__init__(str(Path(__file__).parent / "templates" / "__pycache__"), "%s.jinja")

    def dump_bytecode(self, bucket: Bucket) -> None:
        """Keep what was compiled; a folder that is not ours to write in costs time and nothing else."""
        if not sys.dont_write_bytecode:
            with contextlib.suppress(OSError):
                Path(self.directory).mkdir(exist_ok=True)
                super().dump_bytecode(bucket)


@cache
def _environment() -> Environment:
    environment = Environment(
        bytecode_cache=_Compiled(),
        loader=PackageLoader("autograder", _TEMPLATES),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters.update(lines=_lines, points=points, number=number, visible=visible, plural=plural)
    environment.globals.update(
        style=_asset("style.css"),
        style_hash=hash_of("style.css"),
        script=_asset("table.js"),
        desk_script=_asset("desk.js"),
        script_hash=hash_of("table.js"),
        outcome=outcome,
        bar=charts.bar,
    )
    return environment


def _lines(text: str) -> Markup:
    return Markup("<br>").join(text.split("\n"))


@cache
def _asset(name: str) -> Markup:
    # A file of ours; `</` would end the element it stands in.
    text = (files("autograder") / _TEMPLATES / name).read_text(encoding="utf-8")
    assert "</" not in text
    return Markup(text)


@cache
def hash_of(name: str) -> Markup:
    """Return the hash of a style sheet or script of ours, as a policy names it."""
    digest = hashlib.sha256(_asset(name).encode()).digest()
    return Markup("'sha256-" + base64.b64encode(digest).decode() + "'")
