"""The desk's server: one page for each answer, on 127.0.0.1 only, for whoever was given its address.

Every request must name this very host, which a page from elsewhere cannot make a browser do, and carry the
random token that is in the address. A form must come from the desk's own page.
"""

from __future__ import annotations

import json
import secrets
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any
from urllib.parse import parse_qs

from autograder.desk.page import answer_page, content_policy
from autograder.desk.pile import Pile
from autograder.errors import AutograderError

_LARGEST = 64 << 10  # bytes of a form
_PATIENCE = 10.0  # seconds for a request to arrive


class Desk(ThreadingHTTPServer):
    """A server for one reader.

    Parameters
    ----------
    pile : Pile
        The answers.
    course, guide : str
        What the page shows beside them.
    port : int
        0 for any that is free.
    """

    daemon_threads = True

    def __init__(self, pile: Pile, course: str, guide: str, port: int = 0) -> None:
        self.pile, self.course, self.guide = pile, course, guide
        self.token = secrets.token_urlsafe(24)
        super().__init__(("127.0.0.1", port), _Handler)
        self.hosts = {f"{name}:{self.server_port}" for name in ("127.0.0.1", "localhost")}

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Say nothing of a browser that hung up; its next request is answered as any other."""

    @property
    def address(self) -> str:
        """Where the reader's browser goes."""
        return f"http://127.0.0.1:{self.server_port}/{self.token}/"


class _Handler(BaseHTTPRequestHandler):
    server: Desk
    timeout = _PATIENCE
    server_version, sys_version = "desk", ""

    def do_GET(self) -> None:
        """Show an answer: /TOKEN/, or /TOKEN/7 for the seventh."""
        rest = self._below_token()
        if rest is None:
            return
        pile = self.server.pile
        index = max(pile.next_waiting(-1), 0) if not rest else self._index(rest)
        if index is None:
            self._refuse(HTTPStatus.NOT_FOUND, "There is no such answer.")
            return
        self._send(HTTPStatus.OK, answer_page(pile, index, self.server.course, self.server.guide), "text/html")

    def do_POST(self) -> None:
        """Store a mark, given by the script (answered in JSON) or by the form (answered with the next page)."""
        rest = self._below_token()
        if rest is None:
            return
        if self.headers.get("Origin", "null") not in {f"http://{host}" for host in self.server.hosts}:
            self._refuse(HTTPStatus.FORBIDDEN, "This form does not come from the desk.")
            return
        length = self.headers.get("Content-Length", "")
        index = self._index(rest)
        if not (length.isascii() and length.isdecimal() and int(length) <= _LARGEST):
            self._refuse(HTTPStatus.REQUEST_ENTITY_TOO_LARGE, "This is no form of the desk.")
        elif index is None:
            self._refuse(HTTPStatus.NOT_FOUND, "There is no such answer.")
        else:
            self._store(index, self.rfile.read(int(length)))

    def _index(self, rest: str) -> int | None:
        """Read the number of an answer, from 1; None where there is no such."""
        number = int(rest) if rest.isascii() and rest.isdecimal() and len(rest) < 9 else 0
        return number - 1 if 1 <= number <= len(self.server.pile) else None

    def _store(self, index: int, body: bytes) -> None:
        fields = parse_qs(body.decode("utf-8", "replace"), keep_blank_values=True)
        points, comment = (fields.get(name, [""])[0] for name in ("points", "comment"))
        pile = self.server.pile
        try:
            pile.give(index, points, comment, together=fields.get("together", [""])[0] == "on")
            said: dict[str, object] = {"stored": True, "waiting": pile.waiting, "next": pile.next_waiting(index) + 1}
            status = HTTPStatus.OK
        except AutograderError as error:
            said, status = {"stored": False, "reason": str(error)}, HTTPStatus.UNPROCESSABLE_ENTITY
        if self.headers.get("Accept", "").startswith("application/json"):
            self._send(status, json.dumps(said), "application/json")
        elif status is HTTPStatus.OK:
            self.send_response(HTTPStatus.SEE_OTHER)
            self.send_header("Location", f"/{self.server.token}/{said['next']}")
            self._end(b"", "text/plain")
        else:
            self._refuse(status, str(said["reason"]))

    def _below_token(self) -> str | None:
        """Return the path below the token; answers and returns None where host or token are wrong."""
        if self.headers.get("Host", "") not in self.server.hosts:
            self._refuse(HTTPStatus.FORBIDDEN, "This server answers to its own name only.")
            return None
        _, _, path = self.path.partition("?")[0].partition("/")
        token, slash, rest = path.partition("/")
        if not slash or not secrets.compare_digest(token.encode("utf-8", "replace"), self.server.token.encode()):
            self._refuse(HTTPStatus.NOT_FOUND, "Open the whole address that the terminal shows.")
            return None
        return rest

    def _refuse(self, status: HTTPStatus, reason: str) -> None:
        self.close_connection = True
        self._send(status, f"{reason}\n", "text/plain")

    def _send(self, status: HTTPStatus, text: str, kind: str) -> None:
        self.send_response(status)
        self._end(text.encode(), kind)

    def _end(self, data: bytes, kind: str) -> None:
        for name, value in (
            ("Content-Type", f"{kind}; charset=utf-8"),
            ("Content-Length", str(len(data))),
            ("Content-Security-Policy", content_policy()),
            ("Cache-Control", "no-store"),
            ("Referrer-Policy", "same-origin"),
            ("X-Content-Type-Options", "nosniff"),
            ("X-Frame-Options", "DENY"),
            ("Cross-Origin-Resource-Policy", "same-origin"),
            ("Cross-Origin-Opener-Policy", "same-origin"),
        ):
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(data)

    def log_message(self, format: str, *args: Any) -> None:  # noqa: A002 - http.server names it so
        """Say nothing: the token would stand in every line."""
