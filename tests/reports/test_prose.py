"""A student's markdown is shown and can do nothing."""

from __future__ import annotations

import re
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.reports.prose import LONGEST, prose
from autograder.reports.written import default_guide, written_page
from tests.marking.written import EVIL

PICTURE = "data:image/png;base64,iVBORw0KGgo="
ALLOWED = {"p", "em", "strong", "code", "pre", "ul", "ol", "li", "blockquote", "br", "hr", "table", "thead", "tbody",
           "tr", "th", "td", "img", "span"}  # fmt: skip


def test_markdown_formulas_and_pictures_are_shown() -> None:
    """Emphasis, lists, tables, code; a formula stays as it was typed; an attached picture is data."""
    text = "**b** $a_1 * b_2 * c$\n\n- x\n\n| a |\n|--|\n| 1 |\n\n![plot](attachment:p.png)\n\n```py\nx <b>\n```\n"
    shown = prose(text, {"p.png": PICTURE})
    for words in (
        "<strong>b</strong>",
        '<code class="math">a_1 * b_2 * c</code>',
        "<li>x</li>",
        "<td>1</td>",
        f'<img src="{PICTURE}" alt="plot">',
        '<pre tabindex="0">x &lt;b&gt;\n</pre>',
    ):
        assert words in shown


@pytest.mark.parametrize(
    "text",
    [
        EVIL,
        "[click](javascript:alert(1))",
        "![x](http://evil.example/x.png)",
        "![x](data:text/html;base64,PHNjcmlwdD4=)",
        '![x](attachment:p.png "onerror=alert(1)")',
        "<http://evil.example>",
        '$<img src=x onerror="alert(1)">$',
        "```<script>\nalert(1)\n```",
        "| <b onclick=alert(1)> |\n|:-:|\n| <svg/onload=alert(1)> |",
        "[a]: javascript:alert(1)\n[a]",
        "\u202eevil\u2066 text",
    ],
)
def test_hostile_markdown_is_text(text: str) -> None:
    """No script, no link, no picture from elsewhere, no attribute that the policy would refuse."""
    shown = prose(text, {"p.png": "data:text/html,x"})
    assert {name.lower() for name in re.findall(r"<([A-Za-z]\w*)", shown)} <= ALLOWED - {"img"}
    assert not re.search(r"<[^>]*\s(on\w+|style|href|src)=", shown)
    assert "\u202e" not in shown


@given(st.text(alphabet=st.sampled_from("$*_`[]()!<>&\"'\\|#-\n a1:/"), max_size=80))
def test_any_text_gives_known_elements_in_balance(text: str) -> None:
    """Whatever stands there, every element is ours and is closed."""
    shown = prose(text)
    assert set(re.findall(r"<([A-Za-z]\w*)", shown)) <= ALLOWED
    for name in ALLOWED - {"br", "hr", "img"}:
        assert len(re.findall(rf"<{name}[ >]", shown)) == shown.count(f"</{name}>")


@pytest.mark.parametrize("piece", ["$", "*", "[", "![", "> ", "`", "- ", "|", "<", "\\", "a$b ", "[x](", "_a", "&#"])
def test_no_answer_takes_long(piece: str) -> None:
    """What a parser could be made to stumble over is cut and read in a moment."""
    start = time.process_time()
    shown = prose(piece * 60_000)
    assert time.process_time() - start < 5.0
    assert len(shown) < 40 * LONGEST


def test_the_guide_is_that_of_the_worked_solution() -> None:
    """Unless the course has its own."""
    assert default_guide().startswith("| question | points | given for |")
    assert "Errata" not in default_guide()
    assert "<td>calls the rest rounding" in written_page([])
    assert "<em>mine</em>" in written_page([], guide="*mine*")
