"""A pool of no workers: this process grades, as a worker would, beside a fork server of its own."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import msgspec

from autograder.engine.messages import Answer, Grade, Orders, Ready
from autograder.engine.pool import GIVEN_UP, MAX_LOSSES, Done
from autograder.engine.worker import Examiner, limits_of, plan_of
from autograder.errors import SandboxLost
from autograder.sandbox.host import Sandbox, Server


class Here:
    """Grades one submission after the other; a fork server that is lost is replaced.

    Parameters
    ----------
    orders : callable
        Gives what a worker is told; asked while the fork server starts.
    server : Server, optional
        The fork server, where one was started before.

    Attributes
    ----------
    confinement : Ready or None
        The level of the fork server.
    """

    has_a_processor_each = True

    def __init__(self, orders: Callable[[], bytes], server: Server | None = None) -> None:
        self.orders = orders
        self.confinement: Ready | None = None
        self._server = server
        self._sandbox: Sandbox | None = None

    def __enter__(self) -> Here:
        """Start the fork server; it loads what submissions may use while the exam is read or drawn."""
        self._server = self._server or Server()
        try:
            self._told = msgspec.msgpack.decode(self.orders(), type=Orders)
            self._plan = plan_of(self._told)
            self._begin()
        except BaseException:
            self.close()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """End the fork server."""
        for held in (self._sandbox, self._server):
            if held is not None:
                held.close()
        self._sandbox = self._server = None

    def run(self, jobs: Iterable[tuple[int, Grade]], done: Done) -> None:
        """Run all jobs; call `done` as each ends."""
        for number, job in jobs:
            again: Grade | None = job
            while again is not None:
                again = done(number, self._answer(again))

    def _answer(self, job: Grade) -> Answer:
        for _ in range(MAX_LOSSES):
            try:
                if self._sandbox is None:
                    self._begin()
                return self._examiner.do(job)
            except SandboxLost:
                self.close()
        return GIVEN_UP

    def _begin(self) -> None:
        server, self._server = self._server or Server(), None
        self._sandbox = Sandbox(
            self._plan.inputs, limits_of(self._told), allow_unconfined=self._told.allow_unconfined, server=server
        )
        given = self._sandbox.confinement
        self.confinement = self.confinement or Ready(given.level, given.detail)
        self._examiner = Examiner(self._plan, self._sandbox)
