"""Marking in a real browser: by keyboard alone, without script, and whatever the answers hold."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from autograder.course import Course
from autograder.desk.pile import Pile
from autograder.desk.server import Desk
from autograder.marking.answers import answers
from autograder.marking.marks import read_marks
from autograder.verdicts import Reported
from tests.marking.written import EVIL, answered, written_class
from tests.reports.browser import AXE, CHROMIUM, Browser
from tests.reports.examples import GRAPH

pytestmark = [pytest.mark.slow, pytest.mark.skipif(CHROMIUM is None, reason="no Chromium here; .ci/run installs it")]
TITLE = "document.title"


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    """Start one browser for all tests of this file."""
    with Browser(tmp_path_factory.mktemp("profile")) as browser:
        yield browser


@contextmanager
def served(pile: Pile) -> Iterator[Desk]:
    """Serve a pile."""
    with Desk(pile, "SLAM", "") as desk:
        thread = threading.Thread(target=desk.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True)
        thread.start()
        yield desk
        desk.shutdown()
        thread.join()


@pytest.fixture
def desk(tmp_path: Path) -> Iterator[Desk]:
    """Serve a small pile."""
    with served(Pile(tmp_path, answers(written_class(), {}, Course()))) as desk:
        yield desk


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


def test_the_points_of_the_guide_are_keys(browser: Browser, desk: Desk, tmp_path: Path) -> None:
    """A key gives a point of the guide and takes it back; together they are the points of the question."""
    browser.open(desk.address)
    browser.press("q")
    browser.wait_for("document.getElementById('said').textContent === 'stored'")
    assert given(tmp_path) == {("ann", "2"): (1.0, "")}
    browser.press("w")
    browser.press("q")
    browser.press("q")
    browser.wait_for("document.getElementById('points').value === '2'")
    pressed = "[...document.querySelectorAll('.earned button')].map((one) => one.getAttribute('aria-pressed')).join()"
    assert browser.run(pressed) == "true,true"
    browser.press("n")
    browser.wait_for("document.title.startsWith('2 of 5')")
    assert given(tmp_path) == {("ann", "2"): (2.0, "")}


def test_a_comment_is_used_again(browser: Browser, desk: Desk, tmp_path: Path) -> None:
    """`v` and a digit add what was written before for this question; twice changes nothing."""
    desk.pile.give(0, "1", "Say why.")
    browser.open(f"{desk.address}2")
    for key in "1v1v1":
        browser.press(key)
    browser.press("n")
    browser.wait_for("document.title.startsWith('3 of 5')")
    assert given(tmp_path) == {("ann", "2"): (1.0, "Say why."), ("eve", "2"): (1.0, "Say why.")}
    assert browser.run("document.querySelectorAll('.used').length") == 0


def test_equal_answers_are_marked_together_where_the_reader_wants_it(browser: Browser, tmp_path: Path) -> None:
    """They lie one after the other; `g` gives all of them the mark, without it only the one is marked."""
    class_of_four = [answered("ann", {"2": "It is  zero."}), answered("bob", {"2": "No."})]
    class_of_four += [answered("cy", {"2": "It is zero."}), answered("di", {"2": "It is\nzero."})]
    with served(Pile(tmp_path, answers(class_of_four, {}, Course()))) as desk:
        assert [desk.pile[k].name for k in range(4)] == ["ann", "cy", "di", "bob"]
        browser.open(desk.address)
        browser.press("1")
        browser.wait_for("document.getElementById('said').textContent === 'stored'")
        assert given(tmp_path) == {("ann", "2"): (1.0, "")}
        browser.press("g")
        browser.wait_for("document.getElementById('waiting').textContent === '1'")
        assert {name for name, _ in given(tmp_path)} == {"ann", "cy", "di"}
        assert browser.complaints() == []


def test_maxima_of_two_digits_are_typed(browser: Browser, tmp_path: Path) -> None:
    """Two digits in a row are one number where the question has so many points; else the last one counts."""
    course = Course(points={**Course().points, "written": 30.0})
    with served(Pile(tmp_path, answers([answered("ann")], {}, course))) as desk:
        browser.open(desk.address)
        browser.press("1")
        browser.press("2")
        browser.wait_for("document.getElementById('points').value === '12'")
        browser.press("7")
        browser.press("9")
        browser.wait_for("document.getElementById('points').value === '9'")
        browser.press("n")
        browser.wait_for("document.title.startsWith('2 of 2')")
        assert given(tmp_path) == {("ann", "2"): (9.0, "")}


def test_the_other_answers_lie_beside_the_right_ones(browser: Browser, tmp_path: Path) -> None:
    """Own problem, iterates with what is wrong in brackets, the chosen letter and the right one; text stays text."""
    own = Reported(
        graph=GRAPH,
        right=[[0.0, 1.0, 2.0], [0.0, 1.5, 2.0]],
        iterates=[[0.0, 1.0, 2.0], [0.0, 1.5, None], [7.0]],
        conclusion=f"B{EVIL}",
        choice="",
        right_letter="E",
        letters={"few_poses": "Q"},
    )
    with served(Pile(tmp_path, answers([answered("ann", reported=own)], {}, Course()))) as desk:
        browser.open(desk.address)
        marked = "[...document.querySelectorAll('.matrix mark')].map((one) => one.textContent.slice(7)).join()"
        assert browser.run(marked) == "[nan],[7]"
        assert browser.run("document.querySelectorAll('figure img').length") == 1
        assert "which is no letter of a choice. Right: E." in browser.run("document.body.innerText")
        assert "Q (few_poses)" in browser.run("document.body.innerText")
        assert browser.run(TITLE).endswith("marking SLAM")
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
        assert browser.run("document.querySelectorAll('.answer img').length") == 0
        if AXE:
            assert browser.violations() == []
