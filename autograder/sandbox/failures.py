"""What an exception of a submission means, and what it says, without trusting it."""

from __future__ import annotations

import re

from . import imports
from .frames import MAX_REASON, Outcome
from .policy import STUDENT_MODULE

_CELL = re.compile(r"<cell ([0-9]{1,6})>")


def classify(error: BaseException) -> tuple[Outcome, str]:
    """Sort an exception; the text is the module's name where an import is to blame."""
    kind = type(error)
    if issubclass(kind, imports.ForbiddenImport):
        return Outcome.FORBIDDEN, clean(str(error.name) if isinstance(error, ImportError) else "a module")
    if issubclass(kind, MemoryError):
        return Outcome.MEMORY, "MemoryError"
    if issubclass(kind, NameError) and imports.starred:
        return Outcome.FORBIDDEN, clean(imports.starred[0])  # the name may be one that the star should have brought
    if issubclass(kind, NotImplementedError):
        return Outcome.UNFINISHED, said(error)
    return Outcome.RAISED, said(error)


def said(error: BaseException) -> str:
    """Write `Type: message`; of an exception that cannot even say what it is, the type alone."""
    name = str(type.__dict__["__name__"].__get__(type(error)))[:60]
    try:
        text = str(error)
    except BaseException:  # noqa: BLE001  # its __str__ is the submission's code, too
        return clean(name)
    return clean(f"{name}: {text[:MAX_REASON]}" if text else name)


def located(error: BaseException, text: str) -> str:
    """Add to what an exception says where in the submission it was raised, as [cell:line] counted from 0 and 1.

    The innermost of the submission's own lines counts. The grader looks the line up in the text that it holds.
    """
    try:
        trace, found = BaseException.__dict__["__traceback__"].__get__(error), ""
        while trace is not None:
            name = trace.tb_frame.f_code.co_filename
            cell = _CELL.fullmatch(name)
            if cell or name == f"{STUDENT_MODULE}.py":
                found = f" [{int(cell[1]) - 1 if cell else 0}:{trace.tb_lineno}]"
            trace = trace.tb_next
    except BaseException:  # noqa: BLE001  # whatever the submission did to its exception
        return text
    return text[: MAX_REASON - len(found)] + found


def clean(text: str) -> str:
    """Keep what can be printed, on one line, up to the bound."""
    shown = "".join(letter if letter.isprintable() else " " for letter in text[: 2 * MAX_REASON])
    return " ".join(shown.split())[:MAX_REASON]
