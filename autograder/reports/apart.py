"""Names in little room: whatever is cut away, two of them never look the same."""

from __future__ import annotations

from collections.abc import Iterable
from os.path import commonprefix

from autograder.reports.wording import visible

_DOTS = "..."


def apart(names: Iterable[str], width: int) -> dict[str, str]:
    """Shorten names to a width; where two would look alike, what they share is cut out of the middle.

    A name that no cut of this width tells from the others is shown whole.

    Examples
    --------
    >>> list(apart(["mueller_thomas_1", "mueller_thomas_2", "ada"], 12).values())
    ['muel...mas_1', 'muel...mas_2', 'ada']
    """
    whole = {name: visible(name) for name in names}
    shown = {name: visible(name, width) for name in whole}
    for cut in (_middle, _middle, _whole):
        groups: dict[str, list[str]] = {}
        for name, text in shown.items():
            groups.setdefault(text, []).append(name)
        for alike in groups.values():
            if len(alike) > 1:
                shown.update(zip(alike, cut([whole[name] for name in alike], width), strict=True))
    return shown


def _middle(texts: list[str], width: int) -> list[str]:
    """Keep the beginning of each text, and what follows the part that all of them share."""
    head = width // 3
    room = width - head - len(_DOTS)
    differs = len(commonprefix(texts))
    return [text[:head] + _DOTS + text[max(head, min(differs, len(text) - room)) :][:room] for text in texts]


def _whole(texts: list[str], _width: int) -> list[str]:
    return texts
