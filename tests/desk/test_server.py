"""The desk answers to its own reader only, and stores every mark at once."""

from __future__ import annotations

import http.client
import json
import socket
import threading
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import urlencode

import pytest

from autograder.course import Course
from autograder.desk.pile import Pile
from autograder.desk.server import Desk
from autograder.errors import UsageError
from autograder.marking.answers import answers
from autograder.marking.marks import read_marks
from tests.marking.written import answered, written_class

FORM = {"Content-Type": "application/x-www-form-urlencoded", "Accept": "application/json"}


@pytest.fixture
def desk(tmp_path: Path) -> Iterator[Desk]:
    """Serve a small pile."""
    with Desk(Pile(tmp_path, answers(written_class(), {}, Course())), "SLAM", "") as desk:
        thread = threading.Thread(target=desk.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True)
        thread.start()
        yield desk
        desk.shutdown()
        thread.join()


def ask(desk: Desk, path: str, method: str = "GET", body: str = "", **headers: str) -> tuple[int, str, dict[str, str]]:
    """Ask the server: status, text, headers."""
    connection = http.client.HTTPConnection("127.0.0.1", desk.server_port, timeout=10)
    try:
        connection.request(method, path, body, {name.replace("_", "-"): value for name, value in headers.items()})
        answer = connection.getresponse()
        return answer.status, answer.read().decode(), dict(answer.getheaders())
    finally:
        connection.close()


def post(desk: Desk, number: int, points: str, comment: str = "", **headers: str) -> tuple[int, str, dict[str, str]]:
    """Give a mark as the page's script does."""
    headers = {"Origin": f"http://127.0.0.1:{desk.server_port}", **FORM, **headers}
    body = urlencode({"points": points, "comment": comment})
    return ask(desk, f"/{desk.token}/{number}", "POST", body, **headers)


def test_it_listens_on_this_machine_only(desk: Desk) -> None:
    """127.0.0.1, and the address carries a long random token."""
    assert desk.server_address[0] == "127.0.0.1"
    assert len(desk.token) >= 32
    assert desk.address == f"http://127.0.0.1:{desk.server_port}/{desk.token}/"


def test_a_mark_is_on_disk_when_the_answer_comes(desk: Desk, tmp_path: Path) -> None:
    """Also the next one, also another value, also none again."""
    status, text, _ = post(desk, 1, "1,5", "good")
    assert (status, json.loads(text)) == (200, {"stored": True, "waiting": 4, "next": 2})
    [mark] = read_marks(tmp_path).values()
    assert (mark.submission, mark.question, mark.points, mark.of, mark.comment) == ("ann", "2", 1.5, 2.0, "good")
    post(desk, 5, "3")
    post(desk, 1, "0")
    assert [mark.points for mark in read_marks(tmp_path).values()] == [0.0, 3.0]
    post(desk, 1, "")
    assert len(read_marks(tmp_path)) == 1


@pytest.mark.parametrize(("points", "comment"), [("3", ""), ("-1", ""), ("two", ""), ("nan", ""), ("", "a comment")])
def test_points_that_cannot_be_are_refused(desk: Desk, tmp_path: Path, points: str, comment: str) -> None:
    """The reason is told and nothing is stored."""
    status, text, _ = post(desk, 1, points, comment)
    assert status == 422
    assert json.loads(text)["stored"] is False
    assert read_marks(tmp_path) == {}


def test_a_form_without_script_leads_to_the_next_answer(desk: Desk, tmp_path: Path) -> None:
    """The mark is stored and the browser sent on."""
    status, _, headers = post(desk, 1, "2", Accept="text/html")
    assert (status, headers["Location"]) == (303, f"/{desk.token}/2")
    assert len(read_marks(tmp_path)) == 1


@pytest.mark.parametrize("host", ["evil.example", "127.0.0.1", "127.0.0.1:1", "evil.example:{port}", ""])
def test_another_name_of_this_machine_is_refused(desk: Desk, tmp_path: Path, host: str) -> None:
    """A page from elsewhere that has its name point here gets nothing."""
    host = host.replace("{port}", str(desk.server_port))
    assert ask(desk, f"/{desk.token}/1", Host=host)[0] == 403
    assert post(desk, 1, "1", Host=host)[0] == 403
    assert read_marks(tmp_path) == {}


WRONG = ["/", "/1", "/wrong/1", "/{token}x/1", "/{token}"]
BELOW = ["99", "../etc/passwd", "0", "-1", "1.5", "%31", "1/", "1" * 5000]


@pytest.mark.parametrize("path", [*WRONG, *(f"/{{token}}/{rest}" for rest in BELOW)])
def test_another_address_is_refused(desk: Desk, path: str) -> None:
    """Without the token there is nothing, and with it there are answers only."""
    status, text, _ = ask(desk, path.replace("{token}", desk.token))
    assert status == 404
    assert desk.token not in text


def test_an_address_that_is_none_is_refused(desk: Desk) -> None:
    """Bytes that no browser sends get a refusal too."""
    with socket.create_connection(("127.0.0.1", desk.server_port), timeout=10) as line:
        line.sendall(f"GET http://[bad/1 HTTP/1.1\r\nHost: 127.0.0.1:{desk.server_port}\r\n\r\n".encode())
        assert b" 404 " in line.recv(100)


@pytest.mark.parametrize("origin", ["http://evil.example", "null", "https://127.0.0.1:{port}", "http://127.0.0.1:1"])
def test_a_form_from_elsewhere_is_refused(desk: Desk, tmp_path: Path, origin: str) -> None:
    """Even with the token."""
    assert post(desk, 1, "1", Origin=origin.replace("{port}", str(desk.server_port)))[0] == 403
    body = "points=1&comment="
    assert ask(desk, f"/{desk.token}/1", "POST", body, **FORM)[0] == 403
    assert read_marks(tmp_path) == {}


def test_a_form_that_is_too_large_is_refused(desk: Desk) -> None:
    """Its body is not read."""
    assert post(desk, 1, "1", Content_Length="99999999")[0] == 413


def test_every_answer_has_a_strict_policy(desk: Desk) -> None:
    """Nothing is loaded, framed, stored or sent elsewhere."""
    for path in (f"/{desk.token}/", f"/{desk.token}/2", "/"):
        _, _, headers = ask(desk, path)
        policy = headers["Content-Security-Policy"]
        assert policy.startswith("default-src 'none'; img-src data:;")
        assert "unsafe" not in policy
        assert "frame-ancestors 'none'" in policy
        assert headers["Cache-Control"] == "no-store"
        assert headers["X-Content-Type-Options"] == "nosniff"


def test_hostile_answers_are_text(desk: Desk) -> None:
    """No element of theirs is in the page."""
    _, text, _ = ask(desk, f"/{desk.token}/5")
    assert "&lt;script&gt;document.title=" in text
    assert text.count("<script>") == 1
    assert "<img" not in text


def test_the_desk_begins_with_the_first_answer_that_waits(desk: Desk, tmp_path: Path) -> None:
    """After a break it goes on where it stopped; without any answer it says so."""
    post(desk, 1, "1")
    assert "<title>2 of 5" in ask(desk, f"/{desk.token}/")[1]
    for number in (2, 3, 4, 5):
        post(desk, number, "1")
    assert "<title>1 of 5" in ask(desk, f"/{desk.token}/")[1]


def test_an_empty_pile_is_a_page(tmp_path: Path) -> None:
    """Nobody wrote anything."""
    with Desk(Pile(tmp_path, []), "SLAM", "") as desk:
        thread = threading.Thread(target=desk.handle_request, daemon=True)
        thread.start()
        assert "Nothing to mark" in ask(desk, f"/{desk.token}/")[1]
        thread.join()


def test_a_pile_keeps_marks_of_others(tmp_path: Path) -> None:
    """Two readers at two desks do not write over each other's answers."""
    one, other = (Pile(tmp_path, answers(written_class(), {}, Course())) for _ in range(2))
    one.give(0, "1", "")
    other.give(1, "2", "")
    assert len(read_marks(tmp_path)) == 2
    with pytest.raises(UsageError):
        one.give(0, "9", "")


def test_answers_are_the_same_where_words_and_pictures_are(tmp_path: Path) -> None:
    """Blanks do not count, pictures do; the same words to another question are another answer."""
    one = answered("ann", {"2": "see ![](attachment:a.png)", "3": "zero"}, images={"attachment:a.png": "data:1"})
    two = answered("bob", {"2": "see  ![](attachment:a.png)", "3": "see ![](attachment:a.png)"}, images={})
    three = answered("cy", {"2": "see ![](attachment:a.png)"}, images={"attachment:a.png": "data:1"})
    pile = Pile(tmp_path, answers([one, two, three], {}, Course()))
    assert [(pile[k].name, pile[k].question) for k in range(3)] == [("ann", "2"), ("cy", "2"), ("bob", "2")]
    assert [pile.alike(k) for k in range(5)] == [[0, 1], [0, 1], [2], [3], [4]]


def test_answers_are_marked_together_only_where_it_is_asked(desk: Desk, tmp_path: Path) -> None:
    """All that say the same, at once on disk; the comments are there to be used again."""
    desk.pile = Pile(tmp_path, answers([answered(name) for name in ("ann", "bob", "cy")], {}, Course()))
    post(desk, 1, "2", "good")
    assert set(read_marks(tmp_path)) == {("ann", "2")}
    headers = {"Origin": f"http://127.0.0.1:{desk.server_port}", **FORM}
    body = urlencode({"points": "1", "comment": "well", "together": "on"})
    status, text, _ = ask(desk, f"/{desk.token}/2", "POST", body, **headers)
    assert (status, json.loads(text)["waiting"]) == (200, 3)
    assert {(mark.submission, mark.points) for mark in read_marks(tmp_path).values()} == {
        ("ann", 1.0),
        ("bob", 1.0),
        ("cy", 1.0),
    }
    assert desk.pile.used("2") == ["well"]
    assert desk.pile.used("3") == []
