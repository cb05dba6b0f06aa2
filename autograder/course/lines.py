"""Where in a TOML text a key is set; the parser of the standard library does not say."""

from __future__ import annotations

import tomllib
from typing import Any


def line_of(text: str, keys: tuple[str, ...]) -> int:
    r"""Return the line on which a key of a TOML text is set, 0 where it is not found.

    The parser itself decides: the key is set by the first statement after which it is there.

    Examples
    --------
    >>> line_of("[points]\n# a comment\nresidual = 15\n", ("points", "residual"))
    3
    """
    lines = text.splitlines(keepends=True)
    begin = 0  # the statement that is looked at begins after so many lines
    for end, line in enumerate(lines, start=1):
        if begin == end - 1 and (not line.strip() or line.lstrip().startswith("#")):
            begin = end
            continue
        try:
            data: Any = tomllib.loads("".join(lines[:end]))
        except (RecursionError, ValueError):
            continue  # inside a value of several lines
        for key in keys:
            data = data.get(key) if isinstance(data, dict) else None
        if data is not None:
            return begin + 1
        begin = end
    return 0
