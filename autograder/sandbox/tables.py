"""Functions that answer from tables, put in the place of a submission's own.

A table holds numbers only, for the arguments that it lists: nothing here could answer for others. Asked for those,
a function answers as the submission's own did. Its form, column, list or np.matrix, is what the own one returned.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from types import FunctionType, ModuleType
from typing import Any

import numpy as np

from . import batches
from .frames import Array, Table

Function = Callable[..., Any]


class Lookup:
    """One table, ready to be called.

    Parameters
    ----------
    table : Table
        What to answer.
    objects : sequence
        What integers in the table stand for.
    posegraph : module
        Builds the graphs that come as data.
    own : callable or None
        The submission's own function, asked for everything that the table does not list.
    """

    def __init__(self, table: Table, objects: Sequence[Any], posegraph: ModuleType, own: Function | None) -> None:
        self._places, self._vector, self._own = table.keys, table.vector, own
        self._name, self._shapes, self._kind = table.function, table.shapes, table.kind
        shared: batches.Shared = {}
        self._found = {
            tuple(_key(batches.argument(each, objects, posegraph, shared)) for each in entry.key): [
                (_array(part.constant), None if part.factor is None else _array(part.factor)) for part in entry.parts
            ]
            for entry in table.entries
        }

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        """Answer from the table, or as the submission does."""
        try:
            answer = self._answer(self._placed(arguments, named))
        except Exception:  # noqa: BLE001  # arguments of the submission's own making, which no table lists
            answer = None
        if answer is not None:
            return answer
        if self._own is None:
            raise LookupError(f"{self._name} was called with arguments that it knows nothing about")
        return self._own(*arguments, **named)

    def _placed(self, arguments: tuple[Any, ...], named: dict[str, Any]) -> tuple[Any, ...]:
        if not named or self._own is None:
            return arguments + tuple(named.values())
        return inspect.signature(self._own).bind(*arguments, **named).args

    def _answer(self, arguments: tuple[Any, ...]) -> Any:
        parts = self._found.get(tuple(_key(arguments[place]) for place in self._places))
        if parts is None:
            return None
        given = None if self._vector < 0 else np.asarray(arguments[self._vector], dtype=np.float64)
        matrices = self._kind == "matrix" or any(isinstance(each, np.matrix) for each in arguments)
        values = []
        for (constant, factor), shape in zip(parts, self._shapes, strict=True):
            value = constant.copy()
            if factor is not None and given is not None:
                value += factor @ given.ravel()
                shape = shape or ("column" if given.ndim == 2 else "")  # noqa: PLW2901  # as it was given
            values.append(_formed(value, shape, "matrix" if matrices else self._kind))
        return values[0] if len(values) == 1 else tuple(values)


def put(names: dict[str, Any], table: Table, objects: Sequence[Any], posegraph: ModuleType) -> None:
    """Put a function that answers from a table in the place of the submission's own, wherever that is kept.

    Other names for it, default arguments, containers and closures hold the function itself: so its code is replaced,
    where it is a plain function. Of other callables, all names in the module are bound anew.
    """
    own = names.get(table.function)
    if type(own) is FunctionType and own.__closure__ is None:
        copy = FunctionType(own.__code__, own.__globals__, own.__name__, own.__defaults__)
        copy.__kwdefaults__ = own.__kwdefaults__
        lookup = Lookup(table, objects, posegraph, copy)
        own.__code__, own.__defaults__, own.__kwdefaults__ = _ask.__code__, None, {"lookup_": lookup}
    else:
        lookup = Lookup(table, objects, posegraph, own if callable(own) else None)
        for name, value in list(names.items()):
            if own is not None and value is own:
                names[name] = lookup
    names[table.function] = lookup


def _ask(*arguments: Any, lookup_: Lookup, **named: Any) -> Any:
    """Stand in for the code of a function of the submission; it needs no name from outside."""
    return lookup_(*arguments, **named)


def _array(data: Array) -> np.ndarray:
    return np.frombuffer(data.data, "<f8").reshape(data.shape)


def _key(value: Any) -> Any:
    """Tell arguments apart by value: arrays by shape and numbers, everything else by its own comparison."""
    if isinstance(value, np.ndarray | list | tuple):
        array = np.asarray(value, dtype=np.float64) + 0.0  # so that -0 is 0
        return array.shape, array.tobytes()
    return value


def _formed(value: np.ndarray, shape: str, kind: str) -> Any:
    if value.ndim == 1 and shape:
        value = value[:, None] if shape == "column" else value[None, :]
    if kind == "matrix":
        return np.asmatrix(value)
    return value.tolist() if kind == "list" else value
