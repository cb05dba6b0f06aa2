"""A student's markdown is shown and can do nothing."""

from __future__ import annotations

import re
import time
from xml.etree import ElementTree

import pytest
from hypothesis import given
from hypothesis import strategies as st
from markupsafe import escape

from autograder.render.formula import mathml
from autograder.reports.prose import LONGEST, prose
from autograder.reports.written import default_guide, written_page
from tests.marking.written import EVIL

PICTURE = "data:image/png;base64,iVBORw0KGgo="
TEXT = {"p", "em", "strong", "code", "pre", "ul", "ol", "li", "blockquote", "br", "hr", "img", "span"}
TABLE = {"table", "thead", "tbody", "tr", "th", "td"}
UPRIGHT = '<mi mathvariant="normal">%s</mi>'
MATHS = {"math", "mrow", "mi", "mn", "mo", "msub", "msup", "msubsup", "mfrac", "msqrt", "mover"}
MATHS |= {"mtext", "munder", "munderover", "mspace", "mtable", "mtr", "mtd"}
ALLOWED = TEXT | TABLE | MATHS


def test_markdown_formulas_and_pictures_are_shown() -> None:
    """Emphasis, lists, tables, code; a formula stays as it was typed; an attached picture is data."""
    text = "**b** $a_1 * b_2 * c$\n\n- x\n\n| a |\n|--|\n| 1 |\n\n![plot](attachment:p.png)\n\n```py\nx <b>\n```\n"
    shown = prose(text, {"p.png": PICTURE})
    for words in (
        "<strong>b</strong>",
        "<math><mrow><msub><mi>a</mi><mn>1</mn></msub><mo>*</mo><msub><mi>b</mi><mn>2</mn></msub><mo>*</mo><mi>c</mi>",
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


@pytest.mark.parametrize(
    ("formula", "shown"),
    [
        (r"H\Delta\mathbf x", f'<mrow><mi>H</mi>{UPRIGHT % "Δ"}<mrow class="bold">{UPRIGHT % "x"}</mrow></mrow>'),
        (r"x_i^{2}", "<msubsup><mi>x</mi><mi>i</mi><mn>2</mn></msubsup>"),
        (r"\frac{1}{\sqrt{n}}", "<mfrac><mn>1</mn><msqrt><mi>n</mi></msqrt></mfrac>"),
        ("a<b", "<mrow><mi>a</mi><mo>&lt;</mo><mi>b</mi></mrow>"),
        (r"10^{-16} \approx 0", "<msup><mn>10</mn><mrow><mo>−</mo><mn>16</mn></mrow></msup><mo>≈</mo>"),
        ("a = -b", '<mo>=</mo><mo form="prefix">−</mo><mi>b</mi>'),
        ("a - b", "<mi>a</mi><mo>−</mo><mi>b</mi>"),
        (r"x \text{ if so}", "<mi>x</mi><mtext> if so</mtext>"),
        (r"\sum_i x", "<munder><mo>∑</mo><mi>i</mi></munder><mi>x</mi>"),
        (r"\underset{x}{\mathrm{min}}", '<munder><mrow class="normal"><mrow><mi mathvariant="normal">m</mi>'),
        (r"\operatorname*{argmin}_x", "<munder><mo>argmin</mo><mi>x</mi></munder>"),
        (
            r"\begin{pmatrix} 1 & -2 \cr 0 & x \end{pmatrix}",
            '<mtr><mtd><mn>1</mn></mtd><mtd><mo form="prefix">−</mo><mn>2</mn></mtd></mtr><mtr><mtd><mn>0</mn></mtd>',
        ),
    ],
)
def test_a_formula_becomes_mathml(formula: str, shown: str) -> None:
    """Letters, numbers, signs, fractions, and what stands above and below."""
    assert shown in str(mathml(formula))


@pytest.mark.parametrize(
    "formula",
    [
        r"\begin{matrix}",
        r"\begin{pmatrix} 1",
        r"\begin{pmatrix}" * 20,
        r"\begin{align} 1 \end{align}",
        r"\text {a}",
        "a^",
        "x^2^3",
        "}",
        "{",
        r"\input{f}",
        "{" * 99,
        "x" * 999,
        "a & b",
    ],
)
def test_a_formula_that_is_not_understood_stays_as_it_was_typed(formula: str) -> None:
    """Rather than half of it."""
    assert mathml(formula) is None
    assert f'<code class="math">{escape(formula)}</code>' in prose(f"${formula}$")


@given(st.text(max_size=60))
def test_any_formula_is_well_formed(formula: str) -> None:
    """Every element is closed, nothing of the text is one."""
    shown = mathml(formula)
    if shown is not None:
        ElementTree.fromstring(shown)


def test_the_guide_is_that_of_the_worked_solution() -> None:
    """Unless the course has its own."""
    assert default_guide().startswith("| question | points | given for |")
    assert "Errata" not in default_guide()
    assert "<td>calls the rest rounding" in written_page([])
    assert "<em>mine</em>" in written_page([], guide="*mine*")
