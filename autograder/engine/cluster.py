"""A pool on an existing dask.distributed cluster: one submission a task, each for a worker of our choice.

A scheduler runs the tasks of a lost worker again by itself, as often as it is set to, and counts
against those that only waited there. So the client chooses the worker of every task: then it knows
what a lost worker had, runs that again, alone, and gives up a submission that has cost two workers.
"""

from __future__ import annotations

import contextlib
import itertools
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from queue import Empty, SimpleQueue
from typing import Any

import msgspec

from autograder.engine import remote
from autograder.engine.members import Member, Members, connect
from autograder.engine.messages import Answer, Grade, Graded, Ready, Trouble, decode_message
from autograder.engine.pool import GIVEN_UP, MAX_LOSSES, Done

DEPTH = 2  # tasks a worker has: one that runs and one that waits, so that it is never idle
LOOK_SECONDS = 0.5  # between looks at which workers there are
RESULT_SECONDS = 5.0  # for bytes that a worker says are there


@dataclass
class _Round:
    """The jobs of one call of `run`: still to give, lost once, given."""

    fresh: deque[tuple[int, Grade]]
    done: Done
    suspects: deque[tuple[int, Grade]] = field(default_factory=deque)
    given: dict[int, tuple[int, Grade, Any]] = field(default_factory=dict)  # by task
    losses: dict[int, int] = field(default_factory=dict)  # by job

    def lose(self, task: int) -> None:
        """Take back a task whose worker is lost; its job runs again, alone, or is given up."""
        number, job, future = self.given.pop(task)
        future.cancel()
        self.losses[number] = self.losses.get(number, 0) + 1
        if self.losses[number] < MAX_LOSSES:
            self.suspects.append((number, job))
        else:
            self.finish(number, GIVEN_UP)

    def finish(self, number: int, answer: Answer) -> None:
        """Hand over an answer; a job that comes back goes to the end."""
        again = self.done(number, answer)
        if again is not None:
            self.fresh.append((number, again))


@dataclass
class Cluster:
    """A pool of the workers that a scheduler knows, whoever comes and goes.

    Parameters
    ----------
    orders : callable
        Gives what every worker is told once; asked when the pool is entered.
    address : str
        Where the scheduler listens, as `tcp://host:8786` or `tls://host:8786`.
    least : str
        The weakest confinement that will do; a worker that gives less gets no submission.

    Attributes
    ----------
    confinement : Ready or None
        The weakest level among the workers that were there first.
    """

    orders: Callable[[], bytes]
    address: str
    least: str
    confinement: Ready | None = None
    has_a_processor_each: bool = False  # nobody knows what else runs on those machines
    _ended: SimpleQueue[tuple[str, int]] = field(default_factory=SimpleQueue)
    _tasks: Iterator[int] = field(default_factory=itertools.count)

    def __enter__(self) -> Cluster:
        """Connect, and wait for the answers of all workers that are there."""
        self._members = Members(connect(self.address), self.address, self.orders(), self.least)
        try:
            while self.confinement is None:
                self._members.look()
                self.confinement = self._members.weakest()
                time.sleep(0.05)
        except BaseException:
            self.close()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Let the workers end their fork servers, and leave the cluster as it was."""
        self._members.close()

    def run(self, jobs: Iterable[tuple[int, Grade]], done: Done) -> None:
        """Run all jobs; what a lost worker had is run again, once."""
        now = _Round(deque(jobs), done)
        looked = 0.0
        while now.fresh or now.suspects or now.given:
            if time.monotonic() - looked > LOOK_SECONDS:
                for gone in self._members.look():
                    for task in sorted(gone.tasks):
                        now.lose(task)
                looked = time.monotonic()
            self._give(now)
            with contextlib.suppress(Empty):
                self._read(now, *self._ended.get(timeout=LOOK_SECONDS))

    def _give(self, now: _Round) -> None:
        """Keep all workers busy; a suspect gets a worker to itself, so that it alone is blamed."""
        members = sorted(self._members.fit, key=lambda each: len(each.tasks))
        for index, member in enumerate(members):
            if now.suspects and index < len(now.suspects):
                if not member.tasks:
                    member.alone = True
                    self._send(now, member, *now.suspects.popleft())
                continue
            while now.fresh and not member.alone and len(member.tasks) < DEPTH:
                self._send(now, member, *now.fresh.popleft())

    def _send(self, now: _Round, member: Member, number: int, job: Grade) -> None:
        task = next(self._tasks)
        future = self._members.submit(member.address, remote.work, self._members.run, msgspec.msgpack.encode(job))
        member.tasks.add(task)
        now.given[task] = number, job, future
        future.add_done_callback(lambda _, address=member.address: self._ended.put((address, task)))

    def _read(self, now: _Round, address: str, task: int) -> None:
        """Take the answer of a task that ended; a task that was taken back before says nothing any more."""
        if task not in now.given:
            return
        number, _, future = now.given[task]
        answer = _answer(future)
        member = self._members.all.get(address)
        if member is not None:
            member.tasks.discard(task)
            member.alone = member.alone and bool(member.tasks)
        if isinstance(answer, Trouble) and answer.lost:
            now.lose(task)
            if member is not None and member.ready is not None:
                self._members.greet(member)  # it was born again at the same address, or lost its fork server
        else:
            del now.given[task]
            now.finish(number, answer)


def _answer(future: Any) -> Answer:
    """Read what a worker returned; whatever else comes of a future is a loss."""
    try:
        message = decode_message(future.result(timeout=RESULT_SECONDS))
    except Exception as error:  # noqa: BLE001 - dask raises many kinds: KilledWorker, CancelledError, CommClosedError
        return Trouble(f"{type(error).__name__}: {error}", lost=True)
    return message if isinstance(message, Graded | Trouble) else Trouble("The worker answered out of turn.")
