"""Notebook lines that are not Python: magics, shell commands and help, replaced so that the rest parses."""

from __future__ import annotations

import re

# Cell magics whose cell is Python that runs in the notebook itself; of all others the cell is left out.
_RUNS_THE_REST = frozenset({"time", "timeit", "capture", "prun", "memit", "mprun", "pdb", "debug"})

_CELL_MAGIC = re.compile(r"\s*%%(\w+)?")
_RUNS_A_STATEMENT = re.compile(r"(\s*)%time\s+(\S.*)")
_COMMAND = re.compile(
    r"(\s*)(?:%{1,2}\s?(?:[A-Za-z_]\w*(?:\s.*)?)?|!(?!=).*|\?{1,2}\s*[\w.*%]+\s*;?|%{0,2}[A-Za-z_][\w.*]*(?:\[\w+\])?\s*\?{1,2}\s*;?)\s*"
)
_ASSIGNED = re.compile(r"(\s*)([A-Za-z_][\w.,\s\[\]'\"]*?)\s*=\s*(?:!|%\s*[A-Za-z]).*")


def skipped_magic(text: str) -> str:
    r"""Return the magic of a cell that is left out because of it, as it is written; "" where the cell is run.

    Examples
    --------
    >>> skipped_magic("%%writefile a.py" + chr(10) + "x = 1"), skipped_magic("%%time" + chr(10) + "x = 1")
    ('%%writefile', '')
    """
    lines = text.split("\n")
    while lines and (not lines[0].strip() or ((found := _CELL_MAGIC.match(lines[0])) and found[1] in _RUNS_THE_REST)):
        lines.pop(0)
    magic = _CELL_MAGIC.match(lines[0]) if lines else None
    return f"%%{magic[1] or ''}"[:40] if magic and any(line.strip() for line in lines[1:]) else ""


def without_cell_magic(text: str) -> str:
    r"""Drop the line of a cell magic that runs its cell; where it does something else, drop the cell.

    Examples
    --------
    >>> without_cell_magic("%%time" + chr(10) + "x = 1")
    '\nx = 1'
    >>> without_cell_magic("%%bash" + chr(10) + "rm -r x")
    ''
    """
    lines = text.split("\n")
    first = next((number for number, line in enumerate(lines) if line.strip()), 0)
    magic = _CELL_MAGIC.match(lines[first])
    if magic is None:
        return text
    if magic[1] not in _RUNS_THE_REST:
        return ""
    lines[first] = ""
    return without_cell_magic("\n".join(lines)) if any(lines) else ""


def without_line_magics(text: str) -> str:
    r"""Replace every line that only a notebook understands by one that does nothing.

    Examples
    --------
    >>> without_line_magics("%matplotlib inline" + chr(10) + "files = !ls" + chr(10) + "np.dot?")
    'pass\nfiles = None\npass'
    """
    return "\n".join(_plain(line) for line in text.split("\n"))


def _plain(line: str) -> str:
    runs = _RUNS_A_STATEMENT.fullmatch(line)
    if runs:
        return runs[1] + runs[2]
    if _COMMAND.fullmatch(line):
        return line[: len(line) - len(line.lstrip())] + "pass"
    assigned = _ASSIGNED.fullmatch(line)
    return f"{assigned[1]}{assigned[2]} = None" if assigned else line
