"""The import statement as a submission sees it: allowed modules, stand-ins, and proxies for the rest."""

from __future__ import annotations

import builtins
import sys
from collections.abc import Sequence
from types import ModuleType
from typing import Any, NoReturn

from .policy import ALLOWED, STAND_INS, STUDENT_MODULE
from .standins import NOTHING, no_help, stand_in

_import = builtins.__import__
_OPERATORS = """
    call iter next len getitem setitem delitem contains enter exit bool int float complex index round add radd
    iadd sub rsub isub mul rmul imul matmul rmatmul imatmul truediv rtruediv itruediv floordiv rfloordiv
    ifloordiv mod rmod imod pow rpow ipow neg pos abs invert and rand or ror xor rxor lshift rlshift rshift
    rrshift eq ne lt le gt ge hash array mro_entries format divmod rdivmod reversed trunc floor ceil fspath
"""

starred: list[str] = []  # modules that the submission tried to import with a star, and that are not allowed


class ForbiddenImport(ImportError):  # noqa: N818  # an outcome of a call, named as the reports name it
    """A module that is not allowed was used; `name` says which."""

    def __init__(self, name: str) -> None:
        super().__init__(f"{name} is not allowed here; numpy and parts of the standard library are", name=name)


def _refuse(self: Any, *_: Any, **__: Any) -> NoReturn:
    raise ForbiddenImport(object.__getattribute__(self, "_name"))


class Forbidden:
    """What the name of a module that is not allowed is bound to: every use of it raises.

    Attributes that the import statement itself asks for are proxies again, so that an import
    which is never used costs nothing.
    """

    def __init__(self, name: str, parts: dict[str, Any]) -> None:
        object.__setattr__(self, "_name", name)
        object.__setattr__(self, "_parts", parts)

    def __getattr__(self, name: str) -> Any:
        parts = object.__getattribute__(self, "_parts")
        if name in parts:
            return parts[name]
        raise ForbiddenImport(object.__getattribute__(self, "_name"))

    def __repr__(self) -> str:
        return f"<{object.__getattribute__(self, '_name')}: not allowed here>"

    __setattr__ = __delattr__ = _refuse


for _operator in _OPERATORS.split():
    setattr(Forbidden, f"__{_operator}__", _refuse)


class _Loaded:
    """A module of numpy for a star import: without the parts that numpy would read from disk only now."""

    def __init__(self, module: ModuleType) -> None:
        self._module = module
        there = vars(module)
        names = there.get("__all__") or [name for name in there if not name.startswith("_")]
        self.__all__ = [name for name in names if name in there or f"{module.__name__}.{name}" in sys.modules]

    def __getattr__(self, name: str) -> Any:
        return getattr(self._module, name)


def _proxies(name: str, fromlist: Sequence[str]) -> Forbidden:
    """Make what `import a.b` (the proxy of a) or `from a.b import c` (the proxy of a.b) binds."""
    if "*" in fromlist:
        starred.append(name)
    leaves: dict[str, Any] = {part: Forbidden(name, {}) for part in fromlist if part != "*"}
    leaves["__all__"] = ()
    proxy = Forbidden(name, leaves)
    if fromlist:
        return proxy
    path = name.split(".")
    for depth in range(len(path) - 1, 0, -1):
        proxy = Forbidden(".".join(path[:depth]), {path[depth]: proxy, "__all__": ()})
    return proxy


def student_import(
    name: str,
    globals: Any = None,  # noqa: A002, ARG001  # the names that Python's own import has
    locals: Any = None,  # noqa: A002, ARG001  # as above
    fromlist: Sequence[str] | None = (),
    level: int = 0,
) -> Any:
    """Do what `__import__` does, by the rules for submissions."""
    if level:
        raise ImportError("attempted relative import: a submission is one file, without a package around it")
    root = name.partition(".")[0]
    if root in ALLOWED:
        if root == "numpy" and "*" in (fromlist or ()):
            return _Loaded(_import(name, None, None, ("__name__",), 0))
        return _import(name, None, None, fromlist or (), 0)
    if root in STAND_INS:
        return stand_in(name)
    if root == STUDENT_MODULE:
        raise ModuleNotFoundError(f"No module named {name!r}: a submission cannot import itself", name=name)
    return _proxies(name, tuple(fromlist or ()))


# The builtins of a submission: Python's own, this import, and what a notebook has beside them. Made
# once, in the fork server; a child has its own copy of all memory.
STUDENT_BUILTINS: dict[str, Any] = {
    **vars(builtins),
    "__import__": student_import,
    "get_ipython": NOTHING,
    "display": NOTHING,
    "help": no_help,
}
