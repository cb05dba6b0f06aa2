"""A counterexample as data: tables of got against expected, with every wrong entry known."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from autograder.reports.wording import number

# What each function returns, in the letters of the handout.
LETTERS = {
    "residual": ("f",),
    "jacobian": ("J",),
    "information_matrix": ("Omega",),
    "normal_equations": ("H", "b"),
    "gauss_newton_step": ("dx",),
    "sparsity_pattern": ("J_mask", "H_mask"),
    "range_residual": ("f",),
    "range_jacobian": ("J",),
}
_ROWS_ARE_FACTORS = {"f", "J", "Omega", "J_mask"}
_COLUMNS_ARE_FACTORS = {"Omega"}

# Entries closer than this (of the largest expected entry) are drawn as equal: the judge's own
# tolerances are near rounding, and a reader should see the entry that matters.
_CLOSE = 1e-6
_DUST = 1e-12  # rounding: what is smaller than this (of the largest expected entry) is drawn as 0

_Rows = Sequence[Sequence[Any]]


@dataclass(frozen=True)
class Part:
    """One returned array beside the right one.

    `got` is a table of rows, or words for what came instead. A vector is a table of one column.
    """

    letter: str
    got: tuple[tuple[Any, ...], ...] | str
    expected: tuple[tuple[Any, ...], ...]
    got_shape: tuple[int, ...]
    expected_shape: tuple[int, ...]
    wrong: frozenset[tuple[int, int]]
    rows: tuple[str, ...]
    columns: tuple[str, ...]

    @property
    def same_shape(self) -> bool:
        """Whether entries can be compared one by one."""
        return not isinstance(self.got, str) and self.got_shape == self.expected_shape

    def entries(self) -> tuple[list[list[str]], list[list[str]]]:
        """Write got and expected as text; a wrong entry has as many digits as tell it apart."""
        got = self.got if not isinstance(self.got, str) else ()
        dust = _DUST * max((abs(_real(value)) for row in self.expected for value in row), default=0.0)
        left = [[number(value, dust=dust) for value in row] for row in got]
        right = [[number(value, dust=dust) for value in row] for row in self.expected]
        for r, c in self.wrong:
            digits = 6
            while left[r][c] == right[r][c] and digits < 17:
                digits += 1
                left[r][c], right[r][c] = number(got[r][c], digits), number(self.expected[r][c], digits)
        return left, right


def parts(counterexample: Mapping[str, Any]) -> list[Part]:
    """Lay out what the function returned beside what was expected, one Part for each array.

    Examples
    --------
    >>> [part] = parts({"function": "residual", "x": [0, 1], "expected": [0.5, 0.0], "got": [-0.5, 0.0]})
    >>> part.letter, sorted(part.wrong), part.entries()
    ('f', [(0, 0)], ([['-0.5'], ['0']], [['0.5'], ['0']]))
    """
    letters = LETTERS.get(str(counterexample.get("function", "")), ("value",))
    expected, got = counterexample.get("expected"), counterexample.get("got")
    if expected is None:
        return []
    if len(letters) == 1:
        pairs = [(letters[0], got, expected)]
    else:
        gots = got if isinstance(got, (list, tuple)) and len(got) == len(letters) else [got] * len(letters)
        pairs = list(zip(letters, gots, expected, strict=False))
    found = [_part(letter, g, e, counterexample) for letter, g, e in pairs]
    if any(part.wrong or not part.same_shape for part in found):
        return found
    return [_worst(part) for part in found]


def factors(graph: Mapping[str, Any]) -> list[str]:
    """Name the rows of f, J and Omega by their factors.

    Examples
    --------
    >>> factors({"edges": [[0, 1], [2, 1]], "priors": [0]})
    ['0 -> 1', '2 -> 1', 'prior 0']
    """
    edges = [f"{i} -> {j}" for i, j in graph.get("edges", ())]
    return edges + [f"prior {pose}" for pose in graph.get("priors", ())]


def _part(letter: str, got: Any, expected: Any, counterexample: Mapping[str, Any]) -> Part:
    right, right_shape = _table(expected)
    left: tuple[tuple[Any, ...], ...] | str
    left_shape: tuple[int, ...] = ()
    if isinstance(got, (list, tuple)):
        left, left_shape = _table(got)
    else:
        left = "nothing" if got is None else str(got)
    if isinstance(left, str) or left_shape != right_shape:
        return Part(letter, left, right, left_shape, right_shape, frozenset(), (), ())
    graph = counterexample.get("graph")
    rows = _axis(right_shape[0], letter in _ROWS_ARE_FACTORS, graph)
    columns = _axis(right_shape[1], letter in _COLUMNS_ARE_FACTORS, graph) if len(right_shape) > 1 else ()
    return Part(letter, left, right, left_shape, right_shape, _far(left, right), rows, columns)


def _table(value: Any) -> tuple[tuple[tuple[Any, ...], ...], tuple[int, ...]]:
    rows: Sequence[Any] = value if isinstance(value, (list, tuple)) else [value]
    if any(isinstance(row, (list, tuple)) for row in rows):
        table = tuple(tuple(row) if isinstance(row, (list, tuple)) else (row,) for row in rows)
        return table, (len(table), max((len(row) for row in table), default=0))
    return tuple((entry,) for entry in rows), (len(rows),)


def _errors(got: _Rows, expected: _Rows) -> dict[tuple[int, int], float]:
    errors = {}
    for r, (left, right) in enumerate(zip(got, expected, strict=True)):
        for c, (a, b) in enumerate(zip(left, right, strict=False)):
            gap = abs(_real(a) - _real(b))
            errors[r, c] = float("inf") if math.isnan(gap) else gap
    return errors


def _far(got: _Rows, expected: _Rows) -> frozenset[tuple[int, int]]:
    scale = max((abs(_real(entry)) for row in expected for entry in row), default=0.0)
    return frozenset(where for where, gap in _errors(got, expected).items() if gap > _CLOSE * scale)


def _worst(part: Part) -> Part:
    """Every entry is nearly right, and yet one was judged wrong: point at the worst ones."""
    if isinstance(part.got, str) or not part.same_shape:
        return part
    errors = _errors(part.got, part.expected)
    worst = max(errors.values(), default=0.0)
    return replace(part, wrong=frozenset(where for where, gap in errors.items() if gap > 0 and gap >= worst / 2))


def _real(value: Any) -> float:
    try:
        return float(value)
    except (TypeError, ValueError):
        return float("nan")


def _axis(length: int, of_factors: bool, graph: Any) -> tuple[str, ...]:
    if not of_factors:
        return tuple(f"x{k}" for k in range(length))
    names = factors(graph) if isinstance(graph, Mapping) else []
    return tuple(names) if len(names) == length else tuple(f"row {k}" for k in range(length))
