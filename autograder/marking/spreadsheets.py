"""Foreign text in cells of a spreadsheet: shown, never run, and read back as it was."""

from __future__ import annotations

import re
import unicodedata

# What makes a spreadsheet run a cell instead of showing it, also behind blanks and in full width.
_STARTS_A_FORMULA = tuple("=+-@|%\uff1d\uff0b\uff0d\uff20'")
_CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f\x85\u2028\u2029]")


def cell(text: str) -> str:
    r"""Put an apostrophe before text that a spreadsheet would take for a formula, or that has one already.

    Examples
    --------
    >>> cell("=1+1"), cell("'quoted"), cell("plain"), cell("a\rb")
    ("'=1+1", "''quoted", 'plain', 'a b')
    """
    text = _CONTROL.sub(" ", text)
    return "'" + text if text.lstrip().startswith(_STARTS_A_FORMULA) else text


def bare(text: str) -> str:
    """Take the apostrophe away again.

    Examples
    --------
    >>> bare(cell("=1+1")), bare(cell("'quoted")), bare("plain"), bare("'twas")
    ('=1+1', "'quoted", 'plain', "'twas")
    """
    rest = text.removeprefix("'")
    return rest if rest != text and rest.lstrip().startswith(_STARTS_A_FORMULA) else text


def plain(name: str) -> str:
    """Bring a name that people typed to the form in which names are compared: no outer blanks, composed accents."""
    return unicodedata.normalize("NFC", name.strip())


def exact(value: float) -> str:
    """Write a number without idle zeros and without losing a point.

    Examples
    --------
    >>> exact(1.5), exact(2.0)
    ('1.5', '2')
    """
    return f"{value + 0.0:.12g}"
