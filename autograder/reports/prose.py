"""A student's markdown as HTML that can do nothing: no script, no link to follow, no picture from elsewhere.

Text becomes text, formulas become MathML or stay as they were typed, and pictures are shown only where intake
has kept their data.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any

from markdown_it import MarkdownIt
from markdown_it.renderer import RendererHTML
from markdown_it.rules_inline import StateInline
from markdown_it.token import Token
from markupsafe import Markup, escape

from autograder.render.formula import mathml
from autograder.reports.wording import visible

LONGEST = 20_000  # characters that are shown of one answer
_ATTACHMENT = "attachment:"
_SAFE = ("data:image/png;base64,", "data:image/jpeg;base64,")


def prose(text: str, images: Mapping[str, str] | None = None) -> Markup:
    r"""Render an answer.

    Parameters
    ----------
    text : str
        Markdown with formulas in dollars.
    images : mapping of str to str
        Attachment -> data URI.

    Examples
    --------
    >>> print(prose("*zero*: $x^2$ <script>"), end="")
    <p><em>zero</em>: <math><msup><mi>x</mi><mn>2</mn></msup></math> &lt;script&gt;</p>
    """
    shown = text if len(text) <= LONGEST else f"{text[:LONGEST]}\n\n(cut after {LONGEST} characters)"
    shown = "\n".join(_printable(line) for line in shown.split("\n"))
    return Markup(_parser().render(shown, {"images": images or {}}))  # markdown-it escapes text; the rest is ours


def _printable(line: str) -> str:
    """Replace what could turn text round or hide it; blanks at the front are markdown's."""
    rest = line.lstrip(" ")
    return line[: len(line) - len(rest)] + visible(rest, 0) if not rest.isascii() or not rest.isprintable() else line


@cache
def _parser() -> MarkdownIt:
    parser = MarkdownIt("commonmark", {"html": False, "maxNesting": 12}).enable("table")
    parser.inline.ruler.before("escape", "math", _math)
    parser.add_render_rule("math", _render_math)
    parser.add_render_rule("image", _render_image)
    parser.add_render_rule("link_open", _render_nothing)
    parser.add_render_rule("link_close", _render_address)
    parser.add_render_rule("heading_open", _render_heading)
    parser.add_render_rule("heading_close", _render_heading)
    parser.add_render_rule("fence", _render_code)
    parser.add_render_rule("code_block", _render_code)
    parser.add_render_rule("th_open", _render_cell)
    parser.add_render_rule("td_open", _render_cell)
    return parser


def _math(state: StateInline, silent: bool) -> bool:
    """Read $...$ and $$...$$ before anything inside can be taken for emphasis."""
    text, start = state.src, state.pos
    if text[start] != "$":
        return False
    fence = "$$" if text.startswith("$$", start) else "$"
    begin = start + len(fence)
    end = text.find(fence, begin)
    inside = text[begin:end]
    if end < 0 or end >= state.posMax or not inside.strip() or (fence == "$" and inside != inside.strip()):
        return False
    if not silent:
        token = state.push("math", "code", 0)
        token.content = " ".join(inside.split())
    state.pos = end + len(fence)
    return True


def _render_math(_: RendererHTML, tokens: Sequence[Token], index: int, __: Any, ___: Any) -> str:
    return mathml(tokens[index].content) or f'<code class="math">{escape(tokens[index].content)}</code>'


def _render_image(_: RendererHTML, tokens: Sequence[Token], index: int, __: Any, env: Any) -> str:
    token = tokens[index]
    source, alt = str(token.attrs.get("src", "")), token.content or "picture"
    data = env["images"].get(source.removeprefix(_ATTACHMENT), "") if source.startswith(_ATTACHMENT) else ""
    if data.startswith(_SAFE):
        return f'<img src="{escape(data)}" alt="{escape(visible(alt, 200))}">'
    where = "is not shown" if source.startswith(_ATTACHMENT) else f"at {visible(source, 200)} is not loaded"
    return f'<span class="absent">[{escape(visible(alt, 200))}: this picture {escape(where)}]</span>'


def _render_nothing(_: RendererHTML, __: Sequence[Token], ___: int, ____: Any, _____: Any) -> str:
    return ""


def _render_address(_: RendererHTML, tokens: Sequence[Token], index: int, __: Any, ___: Any) -> str:
    """Show where a link would lead, as text."""
    depth = 0
    for token in reversed(tokens[: index + 1]):
        depth += (token.type == "link_close") - (token.type == "link_open")
        if depth == 0:
            return f" ({escape(visible(str(token.attrs.get('href', '')), 200))})"
    return ""


def _render_heading(_: RendererHTML, tokens: Sequence[Token], index: int, __: Any, ___: Any) -> str:
    """Keep the headings of an answer out of the outline of the page."""
    return '<p class="heading">' if tokens[index].nesting > 0 else "</p>\n"


def _render_code(_: RendererHTML, tokens: Sequence[Token], index: int, __: Any, ___: Any) -> str:
    return f'<pre tabindex="0">{escape(tokens[index].content)}</pre>\n'


def _render_cell(_: RendererHTML, tokens: Sequence[Token], index: int, __: Any, ___: Any) -> str:
    return f"<{tokens[index].tag}>"  # without the style attribute, which the page's policy refuses
