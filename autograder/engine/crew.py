"""Who does the work of a run: this machine or a cluster, and at which level of confinement."""

from __future__ import annotations

from collections.abc import Callable

from autograder.engine.messages import Ready
from autograder.engine.pool import LEVELS, Pool
from autograder.engine.run import Settings
from autograder.errors import SandboxError
from autograder.sandbox.server import Server


def crew(orders: Callable[[], bytes], settings: Settings, most: int, server: Server | None = None) -> Pool:
    """Choose the workers of a run, at most so many; they start when the pool is entered.

    The orders are asked for once, while the workers start. A single submission needs no process
    between this one and the locked child: starting one would take longer than grading. For it
    `server` may be starting already.
    """
    if settings.scheduler is None and most == 1:
        from autograder.engine.here import Here  # noqa: PLC0415 - imported by whoever needs it only

        return Here(orders, server)
    if settings.scheduler is None:
        from autograder.engine.local import LocalPool, default_workers  # noqa: PLC0415 - as above

        return LocalPool(orders, max(1, min(settings.workers or default_workers(), most)))
    from autograder.engine.cluster import Cluster  # noqa: PLC0415 - an extra that not everybody installs

    return Cluster(orders, settings.scheduler, demanded(settings))


def demanded(settings: Settings) -> str:
    """Return the weakest level that will do."""
    return "none" if settings.allow_unconfined else settings.min_confinement


def level_of(pool: Pool, settings: Settings) -> str:
    """Return the level that a pool gives.

    Raises
    ------
    SandboxError
        Where that is weaker than demanded.
    """
    given = pool.confinement or Ready("none", "nothing is known")
    if LEVELS.index(given.level) < LEVELS.index(demanded(settings)):
        raise SandboxError(
            f"This machine confines at level {given.level} ({given.detail}), and {demanded(settings)} is demanded; "
            "`autograder doctor` says what is missing."
        )
    return given.level
