"""Handout and worked solution in a real browser: a clean console, no sideways scrolling, and a few sheets of paper."""

import base64
import re

import pytest

from autograder.problems.families import family
from autograder.problems.problem import worked_problem
from autograder.problems.secret import Secret
from autograder.problems.variants import draw_variant
from autograder.render.handout import render_assignment
from autograder.render.solution import render_solution
from tests.reports.browser import AXE, CHROMIUM, Browser

pytestmark = [pytest.mark.slow, pytest.mark.skipif(CHROMIUM is None, reason="no Chromium here; .ci/run installs it")]

SHEETS = {"solution": 5, "handout": 8, "large": 6}


@pytest.fixture(scope="module")
def browser(tmp_path_factory):
    """One browser for all tests of this file."""
    with Browser(tmp_path_factory.mktemp("profile")) as browser:
        yield browser


@pytest.fixture(scope="module")
def pages(tmp_path_factory):
    """The pages of the worked example, and the solution of a variant with twelve poses."""
    folder = tmp_path_factory.mktemp("pages")
    large = draw_variant(Secret(b"0123456789abcdef"), "2026S", "s1", family("D")).problem
    texts = {
        "solution": render_solution(worked_problem())["SOLUTION.html"],
        "handout": render_assignment(worked_problem())["handout.html"],
        "large": render_solution(large)["SOLUTION.html"],
    }
    for name, text in texts.items():
        (folder / f"{name}.html").write_text(text, encoding="utf-8")
    return folder


@pytest.mark.parametrize("name", list(SHEETS))
@pytest.mark.parametrize("width", [360, 1200])
def test_a_page_opens_cleanly_and_never_scrolls_sideways(browser, pages, name, width):
    """On a phone and on a desk: nothing in the console, nothing fetched, what is wide scrolls in its own frame."""
    path = pages / f"{name}.html"
    browser.open(path, width=width)
    assert browser.complaints() == []
    assert [address for address in browser.requests() if not address.startswith("data:")] == [path.as_uri()]
    assert browser.run("document.documentElement.scrollWidth") <= width
    assert browser.run("[...document.images].every((image) => image.complete && image.naturalWidth > 0)")


@pytest.mark.parametrize("name", list(SHEETS))
@pytest.mark.parametrize("wider", [0, 0.05])
def test_a_page_prints_on_a_few_sheets(browser, pages, name, wider):
    """As black on white, and nothing reaches beyond the edge of A4, also where every letter is a little wider."""
    browser.open(pages / f"{name}.html", width=672)  # 210 mm without the margins
    browser.run(f"document.body.style.letterSpacing = '{wider}em';0")
    browser.send("Emulation.setEmulatedMedia", media="print")
    try:
        assert browser.run("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
        assert browser.run("document.documentElement.scrollWidth") <= 672
    finally:
        browser.send("Emulation.setEmulatedMedia", media="")
    printed = browser.send("Page.printToPDF", preferCSSPageSize=True, printBackground=True)
    sheets = len(re.findall(rb"/Type\s*/Page\b", base64.b64decode(printed["data"])))
    assert 1 <= sheets <= SHEETS[name] + (wider > 0)  # wider letters make more lines


@pytest.mark.parametrize("name", list(SHEETS))
def test_columns_of_a_matrix_are_aligned(browser, pages, name):
    """The entries of a column end at one line, and a bracket is as high as its matrix, whatever fonts there are."""
    browser.open(pages / f"{name}.html")
    ends = browser.run(
        "[...document.querySelectorAll('.pmatrix mtable')].map((table) => [...table.querySelectorAll('mtr')]"
        ".map((row) => [...row.children].map((cell) => cell.lastElementChild.getBoundingClientRect().right)))"
    )
    assert bool(ends) == (name != "handout")
    for matrix in ends:
        for column in zip(*matrix, strict=True):
            assert max(column) - min(column) < 1.0
    assert browser.run(
        "[...document.querySelectorAll('.pmatrix mtable')].every((table) => parseFloat(getComputedStyle(table)"
        ".borderLeftWidth) > 0)"
    )


@pytest.mark.skipif(not AXE, reason="npm install axe-core, then AXE_CORE=node_modules/axe-core/axe.min.js")
@pytest.mark.parametrize("name", list(SHEETS))
def test_a_page_is_accessible(browser, pages, name):
    """The accessibility checker finds nothing."""
    browser.open(pages / f"{name}.html")
    with open(AXE, encoding="utf-8") as file:
        browser.run(file.read() + ";0")
    found = browser.run("axe.run().then((found) => found.violations.map((one) => one.id))")
    assert found == []
