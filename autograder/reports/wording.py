"""How points, numbers and foreign text appear in every report: one spelling everywhere."""

from __future__ import annotations

import math
import unicodedata
from typing import Any

from autograder.verdicts import StageVerdict

# Shape, not only colour, tells the states apart; the words are the legend. `passed` needs no mark.
MARKS = {
    "passed": ("", "full points"),
    "partial": ("~", "partly right"),
    "failed": ("x", "wrong values"),
    "error": ("!", "raised an error"),
    "timeout": ("T", "ran out of time"),
    "memory": ("M", "ran out of memory"),
    "missing": ("-", "not written"),
    "forbidden": ("F", "import not allowed"),
    "awaiting_mark": ("?", "waits for a reader"),
}


def outcome(stage: StageVerdict) -> str:
    """Say in two or three words what became of a stage; a step that is right by itself is not partly right.

    Examples
    --------
    >>> outcome(StageVerdict(name="second_step", status="partial", score=6.0, max_score=10.0))
    'partly right'
    >>> outcome(StageVerdict(name="second_step", status="partial", score=10.0, max_score=10.0))
    'right by itself'
    """
    if stage.status == "partial" and stage.score >= stage.max_score > 0:
        return "right by itself"
    return MARKS[stage.status][1]


def points(value: float) -> str:
    """Write points with at most two decimals and no idle zeros.

    Examples
    --------
    >>> points(15.0), points(7.5), points(20 / 3), points(-0.0)
    ('15', '7.5', '6.67', '0')
    """
    text = f"{value:.2f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def number(value: Any, digits: int = 6, dust: float = 0.0) -> str:
    """Write one entry of an array; -0. and what is at most `dust` are 0, and None (JSON knows no NaN) is nan.

    Examples
    --------
    >>> number(-0.0), number(-1.0), number(0.1 + 0.2), number(None), number(True)
    ('0', '-1', '0.3', 'nan', 'True')
    """
    if value is None:
        return "nan"
    if isinstance(value, bool):
        return str(value)
    if isinstance(value, int):
        return str(value) if abs(value) < 10**9 else f"{value:.{digits}g}"
    if isinstance(value, float):
        if not math.isfinite(value):
            return "nan" if math.isnan(value) else ("inf" if value > 0 else "-inf")
        return "0" if abs(value) <= dust else f"{value:.{digits}g}"
    return visible(str(value), 24)


def visible(text: str, limit: int = 0) -> str:
    r"""Make foreign text safe to print on one line: no control, bidi or line-breaking character stays.

    A name or a message of a student could otherwise move the cursor of the grader's terminal.
    `limit` > 0 cuts longer text, with dots.

    Examples
    --------
    >>> visible("a\x1b[31mb\n c")
    'a\\x1b[31mb c'
    >>> visible("information_matrix", 10)
    'informa...'
    """
    text = " ".join(text.split())
    shown = "".join(c if unicodedata.category(c)[0] != "C" else _escaped(c) for c in text)
    if limit and len(shown) > limit:
        return shown[: max(limit - 3, 0)] + "..."
    return shown


def _escaped(character: str) -> str:
    code = ord(character)
    return f"\\x{code:02x}" if code < 0x100 else f"\\u{code:04x}"


def plural(count: int, noun: str) -> str:
    """Count a noun that takes an s.

    Examples
    --------
    >>> plural(1, "case"), plural(200, "case")
    ('1 case', '200 cases')
    """
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"
