"""Templates with `<< value >>` and `<% statement %>`: braces stay free for Python and for formulas."""

from __future__ import annotations

from importlib import resources
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined

__all__ = ["fill", "source"]

_ENVIRONMENT = Environment(
    loader=PackageLoader("autograder.render"),
    undefined=StrictUndefined,
    autoescape=False,  # the results are Python, Markdown and notebooks, not HTML pages
    block_start_string="<%",
    block_end_string="%>",
    variable_start_string="<<",
    variable_end_string=">>",
    comment_start_string="<#",
    comment_end_string="#>",
    trim_blocks=True,
    lstrip_blocks=True,
    keep_trailing_newline=True,
)


def source(name: str) -> str:
    """Read the text of the template of this name, as it was written."""
    return (resources.files("autograder.render") / "templates" / name).read_text(encoding="utf-8")


def fill(name: str, **values: Any) -> str:
    """Fill the template of this name; a value that is missing is an error, never an empty place."""
    return _ENVIRONMENT.get_template(name).render(values)
