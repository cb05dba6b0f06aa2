"""From text to statements, saving what can be saved where the text is not Python throughout."""

from __future__ import annotations

import ast
import re
import sys
import warnings
from dataclasses import dataclass

from .magics import skipped_magic, without_cell_magic, without_line_magics

# A line that may begin a statement at the top level: no indent, no closing bracket, no continuation of a block,
# no mark of a merge.
_BEGINS = re.compile(r"(?!(?:else|elif|except|finally)\b|<{7}|={7}|>{7}|\|{7})[^\s#)\]}]")
_DEFINES = re.compile(r"(?:async[ \t]+)?def[ \t]+(\w{1,64})", re.ASCII)
_MERGE = re.compile(r"(?:<{7}|>{7}) |={7}$")
_NEWER = re.compile(r"\s*(?:type\s+\w+\s*[=\[]|(?:async\s+)?(?:def|class)\s+\w+\s*\[|except\s+\w+\s*,)")
_TOO_DEEP = "this is nested too deeply to be read"
_MOST_JOINED = 40  # parts tried together where one alone does not parse, as inside a long string


@dataclass(frozen=True)
class Statement:
    """One statement at the top level of a cell, or a part of the text that does not parse or is left out.

    `line` is where it begins, or where its problem is; `names` are the functions that it would have defined.
    """

    number: int
    line: int
    node: ast.stmt | None
    problem: str = ""
    names: frozenset[str] = frozenset()
    skipped: bool = False


def statements(text: str, notebook: bool) -> list[Statement]:
    """Split the text of a cell into statements; what does not parse is one with a problem."""
    text = text.removeprefix("\ufeff").replace("\r\n", "\n").replace("\r", "\n")
    attempts = [text]
    magic = skipped_magic(text) if notebook else ""
    if magic and (names := _defined(text)):
        return [Statement(0, 1, None, f"the cell begins with {magic} and was not run", names, skipped=True)]
    if notebook:
        plain = without_cell_magic(text)
        attempts += [plain, without_line_magics(plain)]
    for attempt in attempts:
        body = _parse(attempt)
        if isinstance(body, list):
            return [Statement(number, _first_line(node), node) for number, node in enumerate(body)]
    return _recovered(attempts[-1])


@dataclass(frozen=True)
class _Problem:
    """Why a text does not parse, and in which of its lines."""

    words: str
    line: int

    @property
    def is_depth(self) -> bool:
        return self.words.endswith(_TOO_DEEP)


def _parse(text: str) -> list[ast.stmt] | _Problem:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # an invalid escape sequence in a docstring is nobody's loss
        try:
            return ast.parse(text).body
        except SyntaxError as error:
            return _problem(error, text)
        except ValueError as error:  # null bytes, lone surrogates
            return _Problem(f"SyntaxError: {error}", 1)
        except (MemoryError, RecursionError) as error:
            return _Problem(f"{type(error).__name__}: {_TOO_DEEP}", 1)


def _problem(error: SyntaxError, text: str) -> _Problem:
    """Put into words what Python says, and what it does not know: marks of a merge, and newer Pythons."""
    lines = text.split("\n")
    line = min(max(error.lineno or 1, 1), len(lines))
    merge = next((number for number, each in enumerate(lines, 1) if _MERGE.match(each)), 0)
    if merge:
        return _Problem("SyntaxError: git conflict markers; keep one of the versions and remove the markers", merge)
    words = f"{type(error).__name__}: {error.msg}"
    if _NEWER.match(lines[line - 1]) or "f-string" in str(error.msg):
        words += f" (this is read by Python {sys.version_info[0]}.{sys.version_info[1]}; does it need a newer one?)"
    return _Problem(words, line)


def _defined(text: str) -> frozenset[str]:
    """Name the functions that a text defines at its top level, whether it parses or not."""
    return frozenset(found[1] for line in text.split("\n") if (found := _DEFINES.match(line)))


def _first_line(node: ast.stmt) -> int:
    decorators: list[ast.expr] = getattr(node, "decorator_list", [])
    return min([node.lineno, *(decorator.lineno for decorator in decorators)])


def _recovered(text: str) -> list[Statement]:
    """Parse part by part: from one line that may begin a statement to the next."""
    lines = text.split("\n")
    starts = [number for number, line in enumerate(lines) if _BEGINS.match(line)]
    starts = [start for place, start in enumerate(starts) if place == 0 or not lines[starts[place - 1]].startswith("@")]
    bounds = [*starts, len(lines)]
    found: list[Statement] = []
    place = 0
    while place < len(starts):
        begin = bounds[place]
        problem: _Problem | None = None
        for end in range(place + 1, min(place + _MOST_JOINED, len(bounds) - 1) + 1):
            body = _parse("\n".join(lines[begin : bounds[end]]))
            if isinstance(body, list):
                break
            problem = problem or body
            if body.is_depth:  # more lines make it no flatter, only slower
                break
        if not isinstance(body, list):
            assert problem is not None
            part = "\n".join(lines[begin : bounds[place + 1]])
            found.append(Statement(len(found), begin + problem.line, None, problem.words, _defined(part)))
            place += 1
            continue
        for node in body:
            ast.increment_lineno(node, begin)
            found.append(Statement(len(found), _first_line(node), node))
        place = end
    return found
