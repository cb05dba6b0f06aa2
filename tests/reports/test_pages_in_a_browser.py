"""The pages in a real browser: they open cleanly everywhere, sort and filter, and let nothing out."""

from __future__ import annotations

import base64
import time
from collections.abc import Iterator
from pathlib import Path

import msgspec
import pytest

from autograder.course import Course
from autograder.marking.answers import answers
from autograder.marking.marks import Mark
from autograder.reports.folder import write_reports
from autograder.reports.written import written_page
from autograder.verdicts import Adjustment
from tests.intake.test_pictures import png
from tests.marking.written import answered, written_class
from tests.reports.browser import AXE, CHROMIUM, Browser
from tests.reports.examples import WRONG_J, WRONG_NORMAL, result, small_class, stage

pytestmark = [pytest.mark.slow, pytest.mark.skipif(CHROMIUM is None, reason="no Chromium here; .ci/run installs it")]

RECORD = {"seed": 7, "examples": 200, "exam": "c" * 64, "confinement": "full", "versions": {"numpy": "2"}}
EVIL = "<script>document.title='evil'</script><img src=x onerror=\"document.title='evil'\">&{{7*7}}"
VIEWS = [(width, dark, script) for width in (360, 1200) for dark in (False, True) for script in (False, True)]


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    """Start one browser for all tests of this file."""
    with Browser(tmp_path_factory.mktemp("profile")) as browser:
        yield browser


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write the pages of a small class, one of them with everything that a page can hold."""
    out = tmp_path_factory.mktemp("out")
    rich = result(
        "rich",
        stage(
            "jacobian", "partial", 7.5, "column 2 of J: got [0 -1 1 0]", WRONG_J, slip="loop_sign", hint="Which pose?"
        ),
        stage(
            "normal_equations", "failed", 0.0, "b is J^T f", {**WRONG_NORMAL, "got": [[[1.0, 0.0], [0.0, 1.0]], [1.0]]}
        ),
        stage("gauss_newton_step", "error", message="raised ValueError", remarks=("returns a list.",)),
        stage("written", "awaiting_mark"),
        notes=("cell 3: SyntaxError",),
        provisional=True,
        awaiting=5.0,
    )
    evil = result(
        "evil",
        stage("residual", "error", message=EVIL, hint=EVIL, remarks=(EVIL,), slip=None),
        stage("jacobian", "failed", message=EVIL, counterexample={**WRONG_J, "got": EVIL}),
        student_id=EVIL,
        variant=EVIL,
        notes=(EVIL,),
    )
    rejected = result("lost", status="rejected", message=EVIL)
    rich = msgspec.structs.replace(
        rich,
        comments={"2": EVIL},
        adjustments=(Adjustment(stage="residual", before=15.0, after=12.0, said=EVIL),),
        flags=(EVIL,),
    )
    write_reports([*small_class(), rich, evil, rejected], out, RECORD, course=f"SLAM {EVIL}")
    data = f"data:image/png;base64,{base64.b64encode(png(wide=1)).decode()}"
    seen = answered(
        "pia", {"2": "see ![plot](attachment:p.png)", "3": "| a | b |\n|---|---|\n| 1 | 2 |"}, images={"p.png": data}
    )
    marks = {("ann", "2"): Mark("ann", "2", 1.0, 2.0, EVIL)}
    listed = answers([*written_class(), seen], marks, Course())
    (out / "written.html").write_text(written_page(listed, f"SLAM {EVIL}"), encoding="utf-8")
    return out


def every_page(out: Path) -> list[Path]:
    """List the kinds of pages: the class, and one of each kind of student."""
    return [
        out / "report.html",
        out / "written.html",
        *(out / "feedback" / f"{name}.html" for name in ("alice", "rich", "evil", "judy", "kim")),
    ]


@pytest.mark.parametrize(("width", "dark", "script"), VIEWS)
def test_pages_open_without_a_complaint_and_load_nothing(
    browser: Browser, pages: Path, width: int, dark: bool, script: bool
) -> None:
    """At phone and desktop width, light and dark, with and without script: an empty console and no request."""
    for path in every_page(pages):
        browser.open(path, width=width, dark=dark, script=script)
        assert browser.complaints() == []
        assert browser.requests() == [path.as_uri()]


@pytest.mark.parametrize("width", [360, 768, 1200])
def test_no_page_scrolls_sideways(browser: Browser, pages: Path, width: int) -> None:
    """What is wide scrolls inside its own frame, the page itself never."""
    for path in every_page(pages):
        browser.open(path, width=width)
        assert browser.run("document.documentElement.scrollWidth") <= width, path


def test_paper_is_white_whole_and_without_controls(browser: Browser, pages: Path) -> None:
    """Printed from dark mode: dark ink on white, nothing beyond the edge of A4, no field to type into."""
    for path in every_page(pages):
        browser.open(path, width=720)
        features = [{"name": "prefers-color-scheme", "value": "dark"}]
        browser.send("Emulation.setEmulatedMedia", media="print", features=features)
        try:
            assert browser.run("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
            assert browser.run("getComputedStyle(document.body).color") == "rgb(0, 0, 0)"
            assert browser.run("document.documentElement.scrollWidth") <= 720, path
            assert browser.run("[...document.querySelectorAll('input')].every((box) => !box.offsetParent)")
        finally:
            browser.send("Emulation.setEmulatedMedia", media="")


def test_dark_mode_is_dark(browser: Browser, pages: Path) -> None:
    """The ground follows the reader's wish."""
    ground = "getComputedStyle(document.body).backgroundColor"
    browser.open(pages / "report.html", dark=True)
    dark = browser.run(ground)
    browser.open(pages / "report.html")
    assert browser.run(ground) == "rgb(253, 253, 251)"
    assert dark == "rgb(22, 24, 27)"


def test_hostile_names_and_messages_are_text(browser: Browser, pages: Path) -> None:
    """Nothing of what a student wrote becomes an element, runs, or is filled in."""
    for path in every_page(pages):
        browser.open(path)
        assert browser.run("document.title") != "evil"
        assert "SLAM <script>" in browser.run("document.title")
        assert browser.run("document.querySelectorAll('img:not([src^=\"data:image/\"])').length") == 0
        assert browser.run("document.querySelectorAll('script').length") == (path.name == "report.html")
    browser.open(pages / "feedback" / "evil.html")
    assert browser.run("document.body.innerText").count("{{7*7}}") >= 4


def test_the_class_table_sorts_by_a_click_and_by_the_keyboard(browser: Browser, pages: Path) -> None:
    """A heading is a button; the second press turns the order round, and the heading says so."""
    browser.open(pages / "report.html")
    names = "[...document.querySelectorAll('table.class tbody th')].map((cell) => cell.textContent)"
    rows = "[...document.querySelectorAll('table.class tbody tr')]"
    totals = f"{rows}.map((row) => row.cells[1].textContent)"
    assert browser.run(names)[0] == "alice"
    head = "document.querySelectorAll('table.class thead th')[0]"
    browser.run(f"{head}.querySelector('button').click()")
    browser.run(f"{head}.querySelector('button').focus()")
    browser.press("\r")
    assert browser.run(f"{head}.getAttribute('aria-sort')") == "descending"
    assert browser.run(names)[-1] == "alice"
    browser.run("document.querySelectorAll('table.class thead th button')[1].click()")
    numbers = [float(text) for text in browser.run(totals) if text]
    assert numbers == sorted(numbers)
    assert browser.run("document.querySelectorAll('[aria-sort]').length") == 1


def test_the_total_is_on_screen_and_a_row_is_one_line(browser: Browser, pages: Path) -> None:
    """At 1280 px without scrolling, whatever the reason of a row; names do not break; the reason opens by a click."""
    browser.open(pages / "report.html", width=1280)
    cells = "[...document.querySelectorAll('table.class tr')].map((row) => row.cells[1].getBoundingClientRect().right)"
    assert max(browser.run(cells)) < 1280
    heights = "[...document.querySelectorAll('table.class tbody tr')].map((row) => row.offsetHeight)"
    assert max(browser.run(heights)) - min(browser.run(heights)) <= 2
    browser.run("document.querySelector('table.class details summary').click()")
    assert "is no notebook" in browser.run("document.querySelector('table.class details[open]').innerText")


def test_the_class_table_filters_while_one_types(browser: Browser, pages: Path) -> None:
    """Only rows with every word stay; the count is told."""
    browser.open(pages / "report.html")
    browser.run("document.getElementById('filter').focus()")
    browser.press("rejected ju")
    assert (
        browser.run("[...document.querySelectorAll('table.class tbody tr')].filter((row) => !row.hidden).length") == 1
    )
    assert browser.run("document.getElementById('shown').textContent") == "1 of 14 shown"


def test_without_script_everything_is_there(browser: Browser, pages: Path) -> None:
    """The controls need a script, so they are hidden without one; every row is shown."""
    browser.open(pages / "report.html", script=False)
    browser.send("Emulation.setScriptExecutionDisabled", value=False)
    assert browser.run("getComputedStyle(document.querySelector('.controls')).display") == "none"
    assert browser.run("document.querySelectorAll('table.class tbody tr').length") == 14


def test_every_link_of_the_class_page_leads_to_a_page(browser: Browser, pages: Path) -> None:
    """A name leads to the student's page."""
    browser.open(pages / "report.html")
    links = set(browser.run("[...document.querySelectorAll('a')].map((link) => link.getAttribute('href'))"))
    assert len(links) == 14
    assert all((pages / link).is_file() for link in links)


def test_a_thousand_submissions_stay_smooth(browser: Browser, tmp_path: Path) -> None:
    """The class page stays under 5 MB and opens and sorts in under 2 s."""
    kinds = small_class()
    many = [msgspec.structs.replace(kinds[k % len(kinds)], submission=f"student_{k:04d}") for k in range(1000)]
    write_reports(many, tmp_path, RECORD)
    path = tmp_path / "report.html"
    assert path.stat().st_size < 5_000_000
    taken = []
    for _ in range(3):  # the best of three: other work on the machine is not the page's
        start = time.perf_counter()
        browser.open(path)
        browser.run("document.querySelectorAll('table.class thead button')[3].click()")
        browser.run("document.body.offsetHeight")
        taken.append(time.perf_counter() - start)
    assert min(taken) < 2.0


@pytest.mark.skipif(not AXE, reason="npm install axe-core, then AXE_CORE=node_modules/axe-core/axe.min.js")
@pytest.mark.parametrize("dark", [False, True])
@pytest.mark.parametrize("width", [360, 1200])
def test_an_accessibility_checker_finds_nothing(browser: Browser, pages: Path, width: int, dark: bool) -> None:
    """axe-core has no violation to report on any page."""
    for path in every_page(pages):
        browser.open(path, width=width, dark=dark)
        assert browser.violations() == [], path
