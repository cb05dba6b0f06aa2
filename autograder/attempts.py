"""Marks are final before anything is explained: what goes wrong while words are looked for costs words only."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from typing import ParamSpec, TypeVar

from msgspec.structs import replace

from autograder.errors import SandboxLost
from autograder.verdicts import StageVerdict

STRICT = "AUTOGRADER_STRICT"  # set by our tests: a failed explanation is then a fault that nobody can overlook

_Given = ParamSpec("_Given")
_Words = TypeVar("_Words")


class Attempts:
    """Tries one step of explaining after another, and remembers which failed.

    Examples
    --------
    >>> attempt = Attempts()
    >>> attempt("counting", len, [1, 2])
    2
    """

    def __init__(self) -> None:
        self.failed: dict[str, None] = {}  # in order, each once

    def __call__(
        self, what: str, step: Callable[_Given, _Words], *given: _Given.args, **named: _Given.kwargs
    ) -> _Words | None:
        """Return what a step returns; None where it fails, which is noted for staff.

        Raises
        ------
        SandboxLost
            Where the fork server has gone: the whole submission is run again elsewhere.
        """
        try:
            return step(*given, **named)
        except SandboxLost:
            raise
        except Exception as error:
            if os.environ.get(STRICT):
                raise
            self.failed[f"{what} failed ({type(error).__name__}: {error})"] = None
            return None

    @property
    def flags(self) -> tuple[str, ...]:
        """Say to staff which words are missing; the marks are whole."""
        return tuple(f"The marks stand, but {each}: please look at its page, and tell us." for each in self.failed)


def only_words(marks: Sequence[StageVerdict], said: Sequence[StageVerdict]) -> list[StageVerdict]:
    """Take the words of what was said, and every mark as it was."""
    return [_only_words(mark, each) for mark, each in zip(marks, said, strict=True)]


def _only_words(mark: StageVerdict, said: StageVerdict) -> StageVerdict:
    checks = [
        replace(check, message=each.message, counterexample=each.counterexample)
        for check, each in zip(mark.checks, said.checks, strict=True)
    ]
    return replace(
        mark,
        checks=tuple(checks),
        message=said.message,
        slip=said.slip,
        hint=said.hint,
        remarks=said.remarks,
        group=said.group,
    )
