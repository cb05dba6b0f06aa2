"""What the engine asks of those who do its work, wherever they are."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Protocol, Self

from autograder.engine.messages import Answer, Grade, Ready, Trouble

LEVELS = ("none", "seccomp", "full")  # of confinement, from weak to strong
MAX_LOSSES = 2  # a submission whose worker is lost so often is given up
GIVEN_UP = Trouble("The worker process was lost twice while this submission ran.", lost=True)


Done = Callable[[int, Answer], Grade | None]
"""Takes the answer to a job, and may return another job of the same number, which is run before all is done."""


class Pool(Protocol):
    """Workers that all hold the same orders; a context manager.

    Attributes
    ----------
    confinement : Ready or None
        The level that every worker gives at least; known as soon as the pool is entered.
    """

    confinement: Ready | None

    @property
    def has_a_processor_each(self) -> bool:
        """Whether every worker has a processor to itself, as far as this grader goes."""

    def __enter__(self) -> Self:
        """Start or find at least one worker, and wait until it is ready."""

    def __exit__(self, *_: object) -> None:
        """Close."""

    def run(self, jobs: Iterable[tuple[int, Grade]], done: Done) -> None:
        """Run all jobs; call `done` as each ends, in any order; what a lost worker had is run again."""

    def close(self) -> None:
        """Let the workers go."""
