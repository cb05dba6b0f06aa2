"""From text to statements, saving what can be saved where the text is not Python throughout."""

from __future__ import annotations

import ast
import re
import warnings
from dataclasses import dataclass

from .magics import without_cell_magic, without_line_magics

# A line that may begin a statement at the top level: no indent, no closing bracket, no continuation of a block.
_BEGINS = re.compile(r"(?!(?:else|elif|except|finally)\b)[^\s#)\]}]")
_TOO_DEEP = "this is nested too deeply to be read"
_MOST_JOINED = 40  # parts tried together where one alone does not parse, as inside a long string


@dataclass(frozen=True)
class Statement:
    """One statement at the top level of a cell, or a part of the text that does not parse."""

    number: int
    line: int
    node: ast.stmt | None
    problem: str = ""


def statements(text: str, notebook: bool) -> list[Statement]:
    """Split the text of a cell into statements; what does not parse is one with a problem."""
    text = text.removeprefix("\ufeff").replace("\r\n", "\n").replace("\r", "\n")
    attempts = [text]
    if notebook:
        plain = without_cell_magic(text)
        attempts += [plain, without_line_magics(plain)]
    for attempt in attempts:
        body = _parse(attempt)
        if not isinstance(body, str):
            return [Statement(number, _first_line(node), node) for number, node in enumerate(body)]
    return _recovered(attempts[-1])


def _parse(text: str) -> list[ast.stmt] | str:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # an invalid escape sequence in a docstring is nobody's loss
        try:
            return ast.parse(text).body
        except SyntaxError as error:
            return f"{type(error).__name__}: {error.msg}"
        except ValueError as error:  # null bytes, lone surrogates
            return f"SyntaxError: {error}"
        except (MemoryError, RecursionError) as error:
            return f"{type(error).__name__}: {_TOO_DEEP}"


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
        problem = ""
        for end in range(place + 1, min(place + _MOST_JOINED, len(bounds) - 1) + 1):
            body = _parse("\n".join(lines[begin : bounds[end]]))
            problem = problem or (body if isinstance(body, str) else "")
            if not isinstance(body, str) or body.endswith(_TOO_DEEP):  # more lines make it no flatter, only slower
                break
        if isinstance(body, str):
            found.append(Statement(len(found), begin + 1, None, problem))
            place += 1
            continue
        for node in body:
            ast.increment_lineno(node, begin)
            found.append(Statement(len(found), _first_line(node), node))
        place = end
    return found
