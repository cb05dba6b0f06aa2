"""Marking in a real browser: by keyboard alone, without script, and whatever the answers hold."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from autograder.course import Course
from autograder.desk.pile import Pile
from autograder.desk.server import Desk
from autograder.marking.answers import answers
from autograder.marking.marks import read_marks
from tests.marking.written import written_class
from tests.reports.browser import AXE, CHROMIUM, Browser

pytestmark = [pytest.mark.slow, pytest.mark.skipif(CHROMIUM is None, reason="no Chromium here; .ci/run installs it")]
TITLE = "document.title"


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    """Start one browser for all tests of this file."""
    with Browser(tmp_path_factory.mktemp("profile")) as browser:
        yield browser


@pytest.fixture
def desk(tmp_path: Path) -> Iterator[Desk]:
    """Serve a small pile."""
    with Desk(Pile(tmp_path, answers(written_class(), {}, Course())), "SLAM", "") as desk:
        thread = threading.Thread(target=desk.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True)
        thread.start()
        yield desk
        desk.shutdown()
        thread.join()


def given(out: Path) -> dict[tuple[str, str], tuple[float, str]]:
    """Return what is on disk."""
    return {key: (mark.points, mark.comment) for key, mark in read_marks(out).items()}


def test_a_pile_is_marked_by_keyboard_and_survives_a_reload(browser: Browser, desk: Desk, tmp_path: Path) -> None:
    """Points, comment, next, a half point more, taking back: each is stored at once."""
    browser.open(desk.address)
    browser.press("2")
    browser.wait_for("document.getElementById('said').textContent === 'stored'")
    assert given(tmp_path) == {("ann", "2"): (2.0, "")}
    browser.press("c")
    browser.press("well done, n 1")
    browser.escape()
    browser.wait_for("document.activeElement === document.body")
    browser.press("n")
    browser.wait_for("document.title.startsWith('2 of 5')")
    assert given(tmp_path) == {("ann", "2"): (2.0, "well done, n 1")}
    browser.press("1")
    browser.press(".")
    browser.wait_for("document.getElementById('points').value === '1.5'")
    browser.press("p")
    browser.wait_for("document.title.startsWith('1 of 5')")
    assert given(tmp_path)["eve", "2"] == (1.5, "")
    browser.open(f"{desk.address}1")
    assert browser.run("document.getElementById('points').value") == "2"
    assert browser.run("document.getElementById('comment').value") == "well done, n 1"
    browser.press("x")
    browser.wait_for("document.getElementById('said').textContent === 'taken back'")
    assert list(given(tmp_path)) == [("eve", "2")]
    browser.press("u")
    browser.wait_for("document.title.startsWith('3 of 5') || document.title.startsWith('1 of 5')")
    assert browser.complaints() == []


def test_points_beyond_the_maximum_are_told_and_not_stored(browser: Browser, desk: Desk, tmp_path: Path) -> None:
    """The reason stands beside the field."""
    browser.open(desk.address)
    browser.press("7")
    browser.wait_for("document.getElementById('said').textContent.includes('nothing was stored')")
    assert given(tmp_path) == {}


def test_a_desk_that_is_gone_is_told(browser: Browser, desk: Desk, tmp_path: Path) -> None:
    """No mark is lost in silence."""
    browser.open(desk.address)
    network = {"latency": 0, "downloadThroughput": -1, "uploadThroughput": -1}
    browser.send("Network.emulateNetworkConditions", offline=True, **network)
    browser.press("1")
    browser.wait_for("document.getElementById('said').textContent.startsWith('NOT stored')")
    browser.send("Network.emulateNetworkConditions", offline=False, **network)
    assert given(tmp_path) == {}


def test_without_script_the_form_is_a_form(browser: Browser, desk: Desk, tmp_path: Path) -> None:
    """Enter in the field of points stores and goes on."""
    browser.open(desk.address, script=False)
    browser.send("Emulation.setScriptExecutionDisabled", value=False)
    browser.run("document.getElementById('points').focus()")
    browser.send("Emulation.setScriptExecutionDisabled", value=True)
    browser.press("1\r")
    browser.send("Emulation.setScriptExecutionDisabled", value=False)
    browser.wait_for("document.title.startsWith('2 of 5')")
    assert given(tmp_path) == {("ann", "2"): (1.0, "")}


@pytest.mark.parametrize("width", [360, 1200])
@pytest.mark.parametrize("dark", [False, True])
def test_every_answer_opens_cleanly(browser: Browser, desk: Desk, width: int, dark: bool) -> None:
    """No complaint, no request to elsewhere, no sideways scrolling, no violation; hostile answers are text."""
    for number in range(1, 6):
        browser.open(f"{desk.address}{number}", width=width, dark=dark)
        assert browser.complaints() == []
        assert browser.requests() == [f"{desk.address}{number}"]
        assert browser.run("document.documentElement.scrollWidth") <= width
        assert browser.run(TITLE).endswith("marking SLAM")
        assert browser.run("document.querySelectorAll('img').length") == 0
        if AXE:
            assert browser.violations() == []
