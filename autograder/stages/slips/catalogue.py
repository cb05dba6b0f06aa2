"""Collects the slips of one stage from plain functions, so that each mistake is written down in one place."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import TypeVar

from autograder.stages.base import Pattern, Slip

Function = TypeVar("Function", bound=Callable[..., object])


class Catalogue:
    """The slips of one stage, in the order in which they are written.

    An instance decorates a wrong implementation. The function's name is the identifier of the
    slip, the first line of its docstring the name, and the rest of the docstring the hint.

    Examples
    --------
    >>> slip = Catalogue()
    >>> @slip("R1", minimum_poses=3)
    ... def row_too_many(x, graph):
    ...     '''The residual has a row too many.
    ...
    ...     Count the factors.
    ...     '''
    >>> slip.entries[0].identifier, slip.entries[0].name, slip.entries[0].hint
    ('row_too_many', 'The residual has a row too many.', 'Count the factors.')
    """

    def __init__(self) -> None:
        self._entries: list[Slip] = []

    @property
    def entries(self) -> tuple[Slip, ...]:
        """All slips so far."""
        return tuple(self._entries)

    def __call__(
        self, catalogue: str = "", *, minimum_poses: int = 2, pattern: Pattern | None = None, remembers: bool = False
    ) -> Callable[[Function], Function]:
        """Return a decorator that takes a function up and leaves it as it is.

        Parameters
        ----------
        catalogue : str
            Identifiers of the mistake in the literature that the course keeps; several where they
            turned out to be the same mistake.
        minimum_poses : int
            Smallest number of poses (columns of J in `normal_equations`) on which it can be seen.
        remembers : bool
            Whether what it answers depends on the calls before.
        pattern : callable or None
            Recognises it where its numbers depend on a constant or on rounding.
        """

        def take_up(function: Function) -> Function:
            name, _, hint = inspect.cleandoc(function.__doc__ or "").partition("\n\n")
            self._entries.append(
                Slip(
                    identifier=function.__name__,
                    name=name,
                    hint=" ".join(hint.split()),
                    function=function,
                    catalogue=catalogue,
                    minimum_poses=minimum_poses,
                    pattern=pattern,
                    remembers=remembers,
                )
            )
            return function

        return take_up
