"""A Markdown page of ours as one HTML file: it opens in any browser without a network, and prints well."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from functools import cache, lru_cache
from html import escape, unescape
from itertools import zip_longest
from math import ceil
from typing import Any

from markdown_it import MarkdownIt
from markdown_it.renderer import RendererHTML
from markdown_it.rules_inline import StateInline
from markdown_it.token import Token

from autograder.render.figure import as_image
from autograder.render.formula import mathml
from autograder.render.template import fill

__all__ = ["printable"]

_LONGEST = 20_000  # characters of a formula: a matrix of ours may be large


def printable(markdown: str, pictures: Mapping[str, str] | None = None) -> str:
    r"""Write a page as HTML, with formulas as MathML and pictures inside.

    Parameters
    ----------
    markdown : str
        The page; it begins with its heading.
    pictures : mapping, optional
        File name -> SVG, for the pictures that the page names.

    Returns
    -------
    str
        One file that loads nothing.

    Raises
    ------
    ValueError
        Where a formula holds something that cannot be written as MathML, or a picture is missing.

    Examples
    --------
    >>> page = printable("# Title\n\nIt is $x^2$.\n")
    >>> "<title>Title</title>" in page, "<msup><mi>x</mi><mn>2</mn></msup>" in page
    (True, True)
    """
    heading, _, _ = markdown.removeprefix("# ").partition("\n")
    body = _parser().render(markdown, {"pictures": pictures or {}})
    return fill("page.html.j2", title=_plain(heading), body=body)


def _plain(heading: str) -> str:
    """Return a heading as text: without code marks, what was escaped as itself, safe in HTML."""
    return escape(re.sub(r"\\(.)", r"\1", re.sub(r"(?<!\\)`", "", heading)), quote=False)


@cache
def _parser() -> MarkdownIt:
    parser = MarkdownIt("commonmark", {"html": False}).enable("table")
    parser.inline.ruler.before("escape", "math", _math)
    parser.add_render_rule("math", _render_math)
    parser.add_render_rule("image", _render_image)
    parser.add_render_rule("heading_open", _render_heading)
    parser.add_render_rule("table_open", _render_table)
    parser.add_render_rule("table_close", _render_table)
    return parser


def _math(state: StateInline, silent: bool) -> bool:
    """Read $...$ and $$...$$ before anything inside can be taken for emphasis."""
    text, start = state.src, state.pos
    if text[start] != "$":
        return False
    fence = "$$" if text.startswith("$$", start) else "$"
    begin = start + len(fence)
    end = text.find(fence, begin)
    if end < 0:
        raise ValueError(f"a formula must end with {fence}, got {text[start : start + 40]!r}")
    if not silent:
        token = state.push("math", "", 0)
        token.content, token.markup = " ".join(text[begin:end].split()), fence
    state.pos = end + len(fence)
    return True


@lru_cache(maxsize=512)
def _formula(content: str, fence: str) -> str:
    shown = mathml(content, _LONGEST)
    if shown is None:
        raise ValueError(f"a formula must be one that MathML can be made of, got {content[:80]!r}")
    if fence == "$$":
        block, frame = shown.replace("<math>", '<math display="block">', 1), "scroll shown"
    elif "<mtable>" in shown:
        block, frame = shown, "scroll"
    else:
        return shown
    return f'<span class="{frame}" style="--ems: {_ems(shown)}" tabindex="0">{block}</span>'


def _ems(shown: str) -> int:
    """Estimate how wide a formula is, in the size of its font: paper does not scroll, so it is made to fit there.

    A character counts 0.75, which few fonts need; of a column its longest cell counts, and its padding.
    """
    rest, *tables = re.split(r"<mtable>(?=<mtr>)", shown)
    columns = 0.0
    for table in tables:
        inside, _, after = table.partition("</mtable>")
        rows = [[_length(cell) for cell in row.split("</mtd>")[:-1]] for row in inside.split("</mtr>")]
        columns += sum(0.75 * longest + 0.8 for longest in map(max, zip_longest(*rows, fillvalue=0)))
        rest += after
    return ceil(columns + 0.75 * _length(rest) + len(tables)) + 1


def _length(markup: str) -> int:
    return len(unescape(re.sub(r"<[^>]*>", "", markup)))


def _render_math(_: RendererHTML, tokens: Sequence[Token], index: int, __: Any, ___: Any) -> str:
    return _formula(tokens[index].content, tokens[index].markup)


def _render_heading(_: RendererHTML, tokens: Sequence[Token], index: int, __: Any, ___: Any) -> str:
    """Name a heading after its words, as GitHub does, so that a table of contents leads there."""
    name = re.sub(r"[^\w -]", "", tokens[index + 1].content.lower()).replace(" ", "-")
    return f'<{tokens[index].tag} id="{name}">'


def _render_image(_: RendererHTML, tokens: Sequence[Token], index: int, __: Any, env: Any) -> str:
    name = str(tokens[index].attrs.get("src", ""))
    if name not in env["pictures"]:
        raise ValueError(f"a picture must be handed over with the page, got {name!r}")
    return as_image(env["pictures"][name])


def _render_table(_: RendererHTML, tokens: Sequence[Token], index: int, __: Any, ___: Any) -> str:
    return '<div class="scroll" tabindex="0"><table>\n' if tokens[index].nesting > 0 else "</table></div>\n"
