"""What a worker of a cluster runs for the engine: bytes in, bytes out, a fork server of its own.

The functions here are the only ones that travel, by name; what a student wrote goes through them as
plain bytes in both directions and is never pickled. One submission runs at a time in a process.
"""

from __future__ import annotations

import atexit
import threading
from dataclasses import dataclass

import msgspec

from autograder.engine.messages import Grade, Orders, Ready, Trouble
from autograder.engine.plan import Plan
from autograder.engine.store import versions
from autograder.engine.worker import Examiner, limits_of, plan_of
from autograder.errors import AutograderError, SandboxLost
from autograder.sandbox.host import Sandbox

MOST_RUNS = 4  # runs that share a worker process; the one that began first makes room


class Greeting(msgspec.Struct, frozen=True, tag=True):
    """What a worker gives: its confinement, and the versions that its verdicts depend on."""

    ready: Ready
    versions: dict[str, str]


def greeting(data: bytes) -> Greeting | Trouble:
    """Read what `prepare` returned."""
    return msgspec.msgpack.decode(data, type=Greeting | Trouble)


@dataclass
class _Held:
    """The exam of one run, and the fork server that stands ready for it."""

    orders: Orders
    plan: Plan
    sandbox: Sandbox
    examiner: Examiner

    @classmethod
    def of(cls, orders: Orders) -> _Held:
        plan = plan_of(orders)
        sandbox = Sandbox(plan.inputs, limits_of(orders), allow_unconfined=orders.allow_unconfined)
        return cls(orders, plan, sandbox, Examiner(plan, sandbox))


_one_at_a_time = threading.Lock()
_held: dict[str, _Held] = {}


def prepare(run: str, orders: bytes) -> bytes:
    """Start a fork server for a run, where there is none yet, and say what this worker gives."""
    with _one_at_a_time:
        try:
            if run not in _held:
                for oldest in list(_held)[: len(_held) - MOST_RUNS + 1]:
                    _drop(oldest)
                _held[run] = _Held.of(msgspec.msgpack.decode(orders, type=Orders))
        except AutograderError as error:
            return msgspec.msgpack.encode(Trouble(str(error), fatal=True, lost=isinstance(error, SandboxLost)))
        except Exception as error:  # noqa: BLE001 - an exception would travel pickled, and may not survive that
            return msgspec.msgpack.encode(Trouble(f"{type(error).__name__}: {error}", fatal=True))
        given = _held[run].sandbox.confinement
        return msgspec.msgpack.encode(Greeting(Ready(given.level, given.detail), versions()))


def work(run: str, job: bytes) -> bytes:
    """Do one job of a run; a worker that has lost its fork server, or was born again, says that it is lost."""
    with _one_at_a_time:
        held = _held.get(run)
        if held is None:
            return msgspec.msgpack.encode(Trouble("This worker knows nothing of the run.", lost=True))
        try:
            return msgspec.msgpack.encode(held.examiner.do(msgspec.msgpack.decode(job, type=Grade)))
        except SandboxLost as error:
            _drop(run)
            return msgspec.msgpack.encode(Trouble(str(error), lost=True))


def leave(run: str) -> None:
    """End the fork server of a run."""
    with _one_at_a_time:
        _drop(run)


def _drop(run: str) -> None:
    held = _held.pop(run, None)
    if held is not None:
        held.sandbox.close()


@atexit.register
def _drop_all() -> None:
    for run in list(_held):
        _drop(run)
