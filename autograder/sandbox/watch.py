"""What became of a function that is asked for: where it was written, and why it is not there, or not the one meant."""

from __future__ import annotations

import ast
import difflib
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Any

from .failures import clean
from .frames import Fate
from .parsing import Statement
from .values import described

_MOST_NAMES = 2000  # of a submission, looked through for one that is close
_CLOSE = 0.8  # of difflib
_BLOCKS = {ast.If: "an if that does not hold", ast.Try: "a try", ast.With: "a with", ast.For: "a loop"}


@dataclass
class _Written:
    """The last definition of a function that succeeded; `parameters` is None where it is no `def`."""

    cell: int
    line: int
    parameters: tuple[str, ...] | None


class Watch:
    """Follows a few names of a submission from statement to statement.

    Parameters
    ----------
    wanted : collection of str
        The functions that will be called.
    names : mapping
        The names of the module, as they change.
    """

    def __init__(self, wanted: Collection[str], names: Mapping[str, Any]) -> None:
        self._wanted = frozenset(wanted)
        self._names = names
        self._last: dict[str, Any] = {}
        self._written: dict[str, _Written] = {}
        self._fates: dict[str, Fate] = {}

    def wants(self, names: Collection[str]) -> bool:
        """Whether one of these functions will be called."""
        return not self._wanted.isdisjoint(names)

    def failed(self, cell: int, statement: Statement, line: int, words: str) -> None:
        """Note a statement that does not parse, was left out, or raised."""
        node = statement.node
        tried = statement.names if node is None else {node.name} if isinstance(node, _DEF) else ()
        how = "skipped" if statement.skipped else "failed"
        for name in self._wanted.intersection(tried):
            if name not in self._written:
                self._note(name, how, cell, line, words)
        self.ran(cell, statement)

    def ran(self, cell: int, statement: Statement) -> None:
        """Compare the names with what they were before a statement."""
        node = statement.node
        for name in self._wanted:
            value = self._names.get(name)
            if value is not self._last.get(name):
                self._last[name] = value
                self._changed(name, value, cell, statement.line, node)
        if node is not None and not isinstance(node, (ast.Import, ast.ImportFrom, ast.Expr)):
            self._look_inside(node, cell)

    def fates(self) -> list[Fate]:
        """Tell what is worth telling of every name that is asked for."""
        for name in sorted(self._wanted.difference(self._fates, self._names)):
            near = self._near(name)
            if near:
                self._note(name, "near", 0, 0, near)
        return [self._fates[name] for name in sorted(self._fates)]

    def _changed(self, name: str, value: Any, cell: int, line: int, node: ast.stmt | None) -> None:
        before = self._written.get(name)
        if not callable(value):
            if before is None:
                self._note(name, "value", cell, line, described(value))
            elif name not in self._names:
                self._note(name, "deleted", before.cell, before.line, "", cell, line)
            else:
                self._note(name, "replaced", before.cell, before.line, _by(node, name, value), cell, line)
            return
        parameters = _parameters(node) if isinstance(node, _DEF) and node.name == name else None
        imported = isinstance(node, (ast.Import, ast.ImportFrom))
        self._fates.pop(name, None)
        if before is not None and imported:
            self._note(name, "replaced", before.cell, before.line, "an import", cell, line)
        elif before is not None and None not in (parameters, before.parameters) and parameters != before.parameters:
            self._note(name, "redefined", before.cell, before.line, ", ".join(parameters or ()), cell, line)
        self._written[name] = _Written(cell, line, parameters)

    def _look_inside(self, node: ast.stmt, cell: int) -> None:
        """Find functions that are written where they cannot be called by their name."""
        if isinstance(node, ast.ClassDef):
            place = f"the class {node.name}"
        elif isinstance(node, _DEF):
            place = f"the function {node.name}"
        else:
            place = next((words for kind, words in _BLOCKS.items() if isinstance(node, kind)), "")
        if not place:
            return
        open_names = self._wanted.difference(self._written, self._fates)
        for inner in ast.walk(node):
            if inner is not node and isinstance(inner, _DEF) and inner.name in open_names:
                self._note(inner.name, "inside", cell, inner.lineno, place)

    def _near(self, name: str) -> str:
        """Return a name of the submission's that may be meant, as it is written there; "" where there is none."""
        own = [
            other
            for other, value in list(self._names.items())[:_MOST_NAMES]
            if type(other) is str and len(other) <= 64 and callable(value) and other not in self._wanted
        ]
        folded = {other.casefold().replace("_", ""): other for other in own}
        found = difflib.get_close_matches(name.replace("_", ""), folded, 1, _CLOSE)
        return folded[found[0]] if found else ""

    def _note(self, name: str, how: Any, cell: int, line: int, words: str, by_cell: int = 0, by_line: int = 0) -> None:
        self._fates[name] = Fate(name, how, cell, line, by_cell, by_line, clean(words))


_DEF = (ast.FunctionDef, ast.AsyncFunctionDef)


def _parameters(node: ast.FunctionDef | ast.AsyncFunctionDef) -> tuple[str, ...]:
    given = [each.arg for each in (*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs)]
    stars = [f"*{each.arg}" for each in (node.args.vararg,) if each is not None]
    return (*given, *stars)


def _by(node: ast.stmt | None, name: str, value: Any) -> str:
    """Say what took the place of a function."""
    if isinstance(node, (ast.For, ast.AsyncFor)) and any(
        isinstance(each, ast.Name) and each.id == name for each in ast.walk(node.target)
    ):
        return "a loop variable"
    if isinstance(node, ast.Assign) and isinstance(node.value, ast.Call):
        called = node.value.func
        if isinstance(called, ast.Name) and called.id == name:
            return f"its own result, {described(value)}"
    return described(value)
