"""The workers of a cluster as its client sees them: who is there, who is fit, who has gone."""

from __future__ import annotations

import contextlib
import time
import uuid
from dataclasses import dataclass, field
from typing import Any

from autograder.engine import remote
from autograder.engine.messages import Ready, Trouble
from autograder.engine.pool import LEVELS
from autograder.engine.store import versions
from autograder.errors import SandboxError, UsageError

CONNECT_SECONDS = 10.0
PATIENCE_SECONDS = 60.0  # without any fit worker, before the run is given up
UNFIT_SECONDS = 5.0  # as long as all that are there are unfit
KEPT = "Results so far are kept; the same command goes on from there."


@dataclass
class Member:
    """One worker process: what it gives, or why it gets nothing, and the tasks that it has."""

    address: str
    answer: Any  # the future of its greeting, until that is read
    ready: Ready | None = None
    unfit: str = ""
    asked: float = field(default_factory=time.monotonic)
    tasks: set[int] = field(default_factory=set)
    alone: bool = False


def connect(address: str) -> Any:
    """Connect to a scheduler.

    Raises
    ------
    UsageError
        Where dask.distributed is not installed, or no scheduler answers.
    """
    try:
        from distributed import Client  # noqa: PLC0415 - an extra that not everybody installs
    except ImportError:
        raise UsageError(
            "--scheduler needs dask.distributed; in the folder of this repository: pip install '.[cluster]'."
        ) from None
    try:
        return Client(address, timeout=CONNECT_SECONDS, set_as_default=False, name="autograder")
    except (OSError, ValueError, TypeError, RuntimeError) as error:
        words = " ".join(str(error).split()) or type(error).__name__
        raise UsageError(
            f"--scheduler {address}: no scheduler answers there ({words}); expected an address such as "
            "tcp://host:8786, which `dask scheduler` prints when it starts."
        ) from None


class Members:
    """All workers that the scheduler knows.

    Parameters
    ----------
    client : distributed.Client
        Closed with the members.
    address : str
        Where the scheduler is, for messages.
    orders : bytes
        What every worker is told once.
    least : str
        The weakest confinement that will do.
    """

    def __init__(self, client: Any, address: str, orders: bytes, least: str) -> None:
        self.client, self.address, self.orders, self.least = client, address, orders, least
        self.run = uuid.uuid4().hex
        self.all: dict[str, Member] = {}
        self._last_fit = time.monotonic()

    @property
    def fit(self) -> list[Member]:
        """Those that may be given submissions."""
        return [each for each in self.all.values() if each.ready is not None]

    def weakest(self) -> Ready | None:
        """Return the weakest level, as soon as everybody has answered and somebody is fit."""
        if not self.fit or any(each.answer is not None for each in self.all.values()):
            return None
        return min((each.ready for each in self.fit if each.ready), key=lambda ready: LEVELS.index(ready.level))

    def look(self) -> list[Member]:
        """Greet who is new, read who has answered, and return who has gone.

        Raises
        ------
        SandboxError
            Where the scheduler has gone, or no fit worker was there for too long.
        """
        try:
            there = set(self.client.nthreads())
        except Exception as error:  # dask raises many kinds
            raise SandboxError(f"The scheduler at {self.address} has gone ({error}). {KEPT}") from error
        gone = [self.all.pop(address) for address in list(self.all) if address not in there]
        for address in sorted(there - self.all.keys()):
            self.greet(Member(address, None))
        for each in self.all.values():
            if each.answer is not None and each.answer.done():
                self._read(each)
            elif each.answer is not None and time.monotonic() - each.asked > PATIENCE_SECONDS:
                each.answer, each.unfit = None, "it does not answer"
        if self.fit:
            self._last_fit = time.monotonic()
        elif time.monotonic() - self._last_fit > (UNFIT_SECONDS if self._none_fit() else PATIENCE_SECONDS):
            raise SandboxError(self._why_nobody())
        return gone

    def greet(self, member: Member) -> None:
        """Tell a worker the orders, and ask what it gives."""
        member.ready, member.asked = None, time.monotonic()
        member.answer = self.submit(member.address, remote.prepare, self.run, self.orders)
        self.all[member.address] = member

    def submit(self, address: str, function: Any, *arguments: Any) -> Any:
        """Have one worker call a function of `remote`; return the future."""
        key = f"autograder-{function.__name__}-{uuid.uuid4().hex}"
        return self.client.submit(
            function, *arguments, key=key, workers=[address], allow_other_workers=False, pure=False, retries=0
        )

    def close(self) -> None:
        """Have every worker end its fork server, and disconnect."""
        with contextlib.suppress(Exception):  # whatever the cluster does by now, the results are stored
            from distributed import wait  # noqa: PLC0415 - as above

            ends = [self.submit(each.address, remote.leave, self.run) for each in self.fit]
            wait(ends, timeout=5.0)
        with contextlib.suppress(Exception):
            self.client.close(timeout=5.0)

    def _read(self, member: Member) -> None:
        future, member.answer = member.answer, None
        try:
            given = remote.greeting(future.result(timeout=CONNECT_SECONDS))
        except Exception as error:  # noqa: BLE001 - such as ModuleNotFoundError, where the package is not installed
            member.unfit = f"{type(error).__name__}: {error}"
            return
        if isinstance(given, Trouble):
            if given.lost:
                self.greet(member)
            member.unfit = "" if given.lost else given.message
        elif LEVELS.index(given.ready.level) < LEVELS.index(self.least):
            member.unfit = f"it confines at level {given.ready.level} ({given.ready.detail}), {self.least} is demanded"
        else:
            other = [
                f"{name} {given.versions.get(name)} instead of {value}"
                for name, value in versions().items()
                if name != "platform" and given.versions.get(name) != value
            ]
            member.unfit = f"it has {', '.join(other)}" if other else ""
            member.ready = None if other else given.ready

    def _none_fit(self) -> bool:
        return bool(self.all) and all(each.unfit for each in self.all.values())

    def _why_nobody(self) -> str:
        if not self.all:
            return f"The cluster at {self.address} has no worker; start some with `dask worker {self.address}`. {KEPT}"
        first = min(self.all.values(), key=lambda each: each.address)
        words = first.unfit or "it does not answer"
        return f"None of the {len(self.all)} workers at {self.address} can grade; {first.address}: {words}. {KEPT}"
