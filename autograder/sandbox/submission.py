"""One submission inside its child: executed statement by statement, its functions found by name."""

from __future__ import annotations
import __future__

import ast
import linecache
import sys
from collections.abc import Callable, Collection, Sequence
from types import ModuleType
from typing import Any

from . import frames, tables
from .failures import classify, clean, said
from .frames import AnswerData, Outcome, Remark, Source, Status
from .imports import STUDENT_BUILTINS, ForbiddenImport
from .parsing import Statement, statements
from .policy import STUDENT_MODULE
from .values import BadValue, described, flatten
from .watch import Watch

Report = Callable[[int, int, int], None]  # cell, statement, line: what is about to run
_MOST_ITERATES = 4096  # elements

_STATUS: dict[Outcome, Status] = {Outcome.FORBIDDEN: "forbidden", Outcome.MEMORY: "memory"}


class Submission:
    """The module that a submission becomes.

    Parameters
    ----------
    source : Source
        What was handed in.
    report : callable
        Is told the cell, number and line of a statement before it runs, if it could do harm.
    wanted : collection of str
        The functions that will be called.
    """

    def __init__(self, source: Source, report: Report, wanted: Collection[str] = ()) -> None:
        self.remarks: list[Remark] = []
        self._source = source
        self._report = report
        # Of `from __future__ import ...`, which holds for all that follows. Annotations are never evaluated: a name
        # in one that is not known, as after a cell with imports was lost, is no reason to lose the function.
        self._flags = __future__.annotations.compiler_flag
        self._module = ModuleType(STUDENT_MODULE)
        self._names: dict[str, Any] = vars(self._module)
        self._names["__builtins__"] = STUDENT_BUILTINS
        if source.kind == "module":
            self._names["__file__"] = f"{STUDENT_MODULE}.py"
        sys.modules[STUDENT_MODULE] = self._module
        self._watch = Watch(wanted, self._names)

    def execute(self, skip: Collection[tuple[int, int]], stop: tuple[int, int] | None) -> None:
        """Run every statement but those of `skip`, up to `stop`."""
        for cell, text in enumerate(self._source.cells):
            if (cell, -1) in skip:
                continue
            if stop is not None and (cell, -1) >= stop:
                return
            self._report(cell, -1, 1)
            found = statements(text, self._source.kind == "notebook")
            filename = f"{STUDENT_MODULE}.py" if self._source.kind == "module" else f"<cell {cell + 1}>"
            linecache.cache[filename] = (len(text), None, text.splitlines(keepends=True), filename)
            for statement in found:
                if stop is not None and (cell, statement.number) >= stop:
                    return
                if (cell, statement.number) in skip:
                    self._watch.failed(cell, statement, statement.line, "")
                else:
                    self._run(cell, statement, filename)

    def _run(self, cell: int, statement: Statement, filename: str) -> None:
        node = statement.node
        if node is None:
            if not statement.skipped:
                self._remark(cell, statement.line, "syntax", statement.problem)
            elif self._watch.wants(statement.names):  # other programs than Python have functions, too
                self._remark(cell, statement.line, "skipped", statement.problem)
            self._watch.failed(cell, statement, statement.line, statement.problem)
            return
        if not _is_quiet(node):
            self._report(cell, statement.number, statement.line)
        try:
            self._flags |= _future(node)
            exec(compile(ast.Module([node], []), filename, "exec", self._flags, dont_inherit=True), self._names)
        except SyntaxError as error:  # found only by the compiler, as `return` outside a function
            line = max(error.lineno or 0, statement.line)
            self._remark(cell, line, "syntax", said(error))
            self._watch.failed(cell, statement, line, said(error))
        except BaseException as error:  # noqa: BLE001  # whatever a statement raises, the next one counts
            outcome, text = classify(error)
            if outcome is Outcome.FORBIDDEN:
                self._stand_for(node, text)
                text = f"{text} is not allowed here"
            self._remark(cell, statement.line, _STATUS.get(outcome, "error"), text)
            self._watch.failed(cell, statement, statement.line, text)
        else:
            self._watch.ran(cell, statement)

    def _stand_for(self, node: ast.stmt, module: str) -> None:
        """Bind the name of a function whose definition used a module that is not allowed.

        Calling it then says why it is not there, instead of that it was never written.
        """
        if isinstance(node, ast.FunctionDef) and node.name not in self._names:

            def missing(*_: Any, **__: Any) -> None:
                raise ForbiddenImport(module)

            self._names[node.name] = missing

    def _remark(self, cell: int, line: int, status: Status, message: str) -> None:
        if len(self.remarks) < frames.MAX_NOTES // 2:
            self.remarks.append(Remark(cell, line, status, clean(message)))

    def function(self, name: str) -> Callable[..., Any] | None:
        """Give what a name is bound to, where that can be called."""
        value = self._names.get(name)
        return value if callable(value) else None

    def replace(self, found: Sequence[frames.Table], objects: Sequence[Any], posegraph: ModuleType) -> None:
        """Put functions that answer from tables in the place of the submission's own."""
        for table in found:
            tables.put(self._names, table, objects, posegraph)

    def fates(self) -> list[frames.Fate]:
        """Tell what became of the functions that will be called, where that is worth telling."""
        return self._watch.fates()

    def functions(self) -> list[str]:
        """List the names that can be called, the submission's own and imported ones."""
        names = [name for name, value in list(self._names.items()) if type(name) is str and callable(value)]
        return [name for name in names if len(name) <= 64 and name.isprintable()][: frames.MAX_FUNCTIONS]

    def answers(self) -> AnswerData:
        """Read the four answers; what is not of the right kind is named and left out."""
        bad: list[str] = []
        shape, data = None, b""
        iterates = self._names.get("iterates")
        if iterates is not None:
            try:
                shape, data, _ = flatten(iterates, _MOST_ITERATES)
            except BadValue as error:
                bad.append(f"iterates: got {error}")
            except BaseException as error:  # noqa: BLE001  # an array-like of the submission's own making
                bad.append(f"iterates: {said(error)}")
        texts = {
            name: self._text(name, most, bad)
            for name, most in (
                ("conclusion", frames.MAX_REASON),
                ("written_2", frames.MAX_WRITTEN),
                ("written_3", frames.MAX_WRITTEN),
            )
        }
        return AnswerData(
            shape, data, texts["conclusion"], texts["written_2"], texts["written_3"], clean("; ".join(bad))
        )

    def _text(self, name: str, most: int, bad: list[str]) -> str | None:
        value = self._names.get(name)
        if value is None:
            return None
        if not issubclass(type(value), str):
            bad.append(f"{name}: got {described(value)}, expected a string")
            return None
        text = str.__str__(value)
        if len(text) > most:
            bad.append(f"{name}: got {len(text)} characters, at most {most} are read")
            return None
        return text.encode("utf-8", "replace").decode("utf-8")


def _is_quiet(node: ast.stmt) -> bool:
    """Tell whether a statement cannot hang: imports, docstrings, plain function definitions."""
    if isinstance(node, (ast.Import, ast.ImportFrom)):
        return True
    if isinstance(node, ast.Expr):
        return isinstance(node.value, ast.Constant)
    if not isinstance(node, ast.FunctionDef) or node.decorator_list:
        return False
    head = [node.args, *([node.returns] if node.returns else [])]
    return not any(
        isinstance(inner, (ast.Call, ast.BinOp, ast.comprehension)) for part in head for inner in ast.walk(part)
    )


def _future(node: ast.stmt) -> int:
    if not isinstance(node, ast.ImportFrom) or node.module != "__future__":
        return 0
    flags = 0
    for alias in node.names:
        if alias.name in __future__.all_feature_names:
            flags |= getattr(__future__, alias.name).compiler_flag
    return flags
