"""What a worker of the tests loads first: it can be made to die of one submission, and to seem weaker than it is.

A locked submission can do neither, so the tests put it into the worker.
"""

from __future__ import annotations

import os

import msgspec

from autograder.engine import remote
from autograder.engine.messages import Ready

# Dask may load this file twice, and the second time the functions are ours already.
_work, _prepare = remote.__dict__.setdefault("_own", (remote.work, remote.prepare))


def work(run: str, job: bytes) -> bytes:
    """Die at the word; do the job otherwise."""
    if os.environ["POISON"].encode() in job:
        os._exit(9)
    return _work(run, job)


def prepare(run: str, orders: bytes) -> bytes:
    """Claim the level, or the version of numpy, that the environment names."""
    given = remote.greeting(_prepare(run, orders))
    assert isinstance(given, remote.Greeting)
    level = os.environ.get("CLAIMED_LEVEL", given.ready.level)
    numpy = os.environ.get("CLAIMED_NUMPY", given.versions["numpy"])
    claimed = remote.Greeting(Ready(level, given.ready.detail), {**given.versions, "numpy": numpy})
    return msgspec.msgpack.encode(claimed)


remote.work, remote.prepare = work, prepare
