"""Pages that open without a network and print: every formula is shown, every picture is inside."""

import re
from html.parser import HTMLParser
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from autograder.problems.families import family
from autograder.problems.problem import worked_problem
from autograder.problems.secret import Secret
from autograder.problems.variants import draw_variant
from autograder.render.facts import solve
from autograder.render.handout import render_assignment
from autograder.render.page import printable
from autograder.render.solution import render_solution
from tests.render.another import another_problem

ROOT = Path(__file__).parents[2]
VOID = {"meta", "img", "br", "hr"}


class Outline(HTMLParser):
    """Elements of a page; an element that is not closed, or closed twice, is an error."""

    def __init__(self, page):
        super().__init__()
        self.open, self.names, self.attributes = [], [], []
        self.feed(page)
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        self.names.append(tag)
        self.attributes += attrs
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


def pages():
    """The solution and the handout of two problems, with the Markdown that each was made of."""
    for problem in (worked_problem(), another_problem()):
        solution, folder = render_solution(problem), render_assignment(problem)
        yield pytest.param(solution["SOLUTION.md"], solution["SOLUTION.html"], id=f"solution-{problem.variant}")
        yield pytest.param(folder["README.md"], folder["handout.html"], id=f"handout-{problem.variant}")


def numbers(matrix):
    """Entries of a matrix that is written as MathML."""
    rows = matrix.findall(".//mtr")
    return np.array([["".join(cell.itertext()).replace("−", "-") for cell in row] for row in rows], dtype=float)


def test_the_page_is_current():
    """The committed solution is what rendering gives."""
    rendered = render_solution(worked_problem())["SOLUTION.html"]
    assert (ROOT / "reference_solution" / "SOLUTION.html").read_text(encoding="utf-8") == rendered


@pytest.mark.parametrize(("markdown", "page"), list(pages()))
def test_a_page_is_whole_and_loads_nothing(markdown, page):
    """Elements are balanced, there is no script and no address to fetch from, and no picture lacks its words."""
    outline = Outline(page)
    assert not {"script", "link", "iframe", "object"} & set(outline.names)
    addresses = [value for name, value in outline.attributes if name in ("src", "href", "data", "srcset")]
    addresses = [address for address in addresses if not address.startswith("#")]  # a place on this page
    assert all(address.startswith("data:image/svg+xml") for address in addresses)
    assert len(addresses) == len(re.findall(r"!\[", markdown))
    assert outline.names.count("img") == sum(name == "alt" and len(value) > 30 for name, value in outline.attributes)
    assert "default-src 'none'" in page


@pytest.mark.parametrize(("markdown", "page"), list(pages()))
def test_every_formula_is_shown(markdown, page):
    """As many as there are in the Markdown, each well formed, none left as it was typed; rows of tables too."""
    formulas = re.findall(r"<math.*?</math>", page, re.DOTALL)
    assert len(formulas) == len(re.findall(r"\$\$.+?\$\$|\$[^$]+\$", markdown, re.DOTALL))
    assert page.count('<math display="block">') == markdown.count("$$") / 2
    words = re.sub(r"<style>.*?</style>|<[^>]*>", "", page, flags=re.DOTALL)
    assert not re.search(r"[$\\]", words)
    for formula in formulas:
        ElementTree.fromstring(formula)
    assert page.count("<tr>") == len(re.findall(r"^\|(?!---)", markdown, re.MULTILINE))


@pytest.mark.parametrize("problem", [worked_problem(), another_problem()], ids=["worked", "another"])
def test_the_matrices_on_paper_are_right(problem):
    """J and H are read back from the page, entry by entry."""
    own = solve(problem)
    page = render_solution(problem)["SOLUTION.html"]
    matrices = [
        numbers(matrix)
        for formula in re.findall(r"<math.*?</math>", page, re.DOTALL)
        for matrix in ElementTree.fromstring(formula).iter("mtable")
    ]
    for wanted in (own.J, own.H, own.b[None], own.x1[None]):
        assert any(matrix.shape == wanted.shape and np.allclose(matrix, wanted, atol=1e-4) for matrix in matrices)


@pytest.mark.parametrize("letter", ["W", "A", "B", "C", "D", "L"])
def test_every_family_has_a_page_to_print(letter):
    """Also large matrices, and two loops, are written as MathML."""
    problem = draw_variant(Secret(b"0123456789abcdef"), "2026S", "s1", family(letter)).problem
    Outline(render_solution(problem)["SOLUTION.html"])
    Outline(render_assignment(problem)["handout.html"])


def test_paper_has_rules_of_its_own():
    """A4, nothing cut through a row or a formula, headings with what follows, no scroll bars."""
    page = render_solution(worked_problem())["SOLUTION.html"]
    assert "@page { size: A4;" in page
    paper = page.partition("@media print {")[2].partition("</style>")[0]
    for rule in ("break-inside: avoid", "break-after: avoid", "overflow: visible", "display: table-header-group"):
        assert rule in paper


@pytest.mark.parametrize(
    ("markdown", "words"),
    [
        ("# T\n\n$\\input{f}$\n", "must be one that MathML can be made of"),
        ("# T\n\n$x\n", r"must end with \$"),
        ("# T\n\n![p](p.svg)\n", "must be handed over with the page, got 'p.svg'"),
    ],
)
def test_what_cannot_be_shown_is_an_error(markdown, words):
    """Never half a page: an unknown formula, an open one, a picture that is missing."""
    with pytest.raises(ValueError, match=words):
        printable(markdown)
