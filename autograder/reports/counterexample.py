"""One counterexample as text: the graph, the call to repeat, and got against expected, aligned."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from autograder.reports.comparison import Part, parts
from autograder.reports.picture import picture
from autograder.reports.reproduce import call_text
from autograder.reports.wording import number, visible

_LARGEST_MATRIX = 6
_LONGEST_VECTOR = 12


def counterexample_text(counterexample: Mapping[str, Any], indent: str = "") -> str:
    """Write a counterexample for a terminal or a forum post; no colour is needed to read it.

    Examples
    --------
    >>> graph = {"n_poses": 2, "edges": [[0, 1]], "measurements": [1.0], "edge_variances": [0.01],
    ...          "priors": [0], "prior_means": [0.0], "prior_variances": [0.001]}
    >>> print(counterexample_text({"function": "residual", "graph": graph, "x": [0.0, 3.0],
    ...                            "expected": [-2.0, 0.0], "got": [2.0, 0.0]}))
           1
    x0 ---------> x1
    ^ prior, mean 0
    <BLANKLINE>
    graph = PoseGraph(
        n_poses=2,
        edges=[(0, 1)],
        measurements=[1],
        edge_variances=[0.01],
        priors=[0],
        prior_means=[0],
        prior_variances=[0.001],
    )
    x = np.array([0.0, 3.0])
    residual(x, graph)
    <BLANKLINE>
    f        got    expected   (wrong entries in brackets)
    0 -> 1    [2]         -2
    prior 0    0           0
    """
    graph = counterexample.get("graph")
    blocks = [picture(graph)] if isinstance(graph, Mapping) else []
    blocks.append(call_text(counterexample))
    found = parts(counterexample)
    if len(found) > 1 and isinstance(counterexample.get("got"), str):
        blocks.append(f"got {visible(str(counterexample['got']), 200)}")
        blocks += [f"{part.letter}:" + _whole("expected", part.expected, part.expected_shape) for part in found]
    else:
        blocks += [part_text(part) for part in found]
    text = "\n\n".join(block for block in blocks if block)
    return "\n".join(indent + line if line else line for line in text.splitlines())


def part_text(part: Part) -> str:
    """Write got and expected side by side; wrong entries stand in [brackets]."""
    if isinstance(part.got, str):
        came = visible(part.got, 200)
        return f"{part.letter}: got {came}, expected an array of shape {part.expected_shape}" + _whole(
            "expected", part.expected, part.expected_shape
        )
    if not part.same_shape:
        return (
            f"{part.letter}: got shape {part.got_shape}, expected shape {part.expected_shape}"
            + _whole("got", part.got, part.got_shape)
            + _whole("expected", part.expected, part.expected_shape)
        )
    if not part.wrong:
        return f"{part.letter}: as expected"
    if not _fits(part.expected, part.expected_shape):
        return first_difference(part)
    return _vector(part) if len(part.expected_shape) == 1 else _matrix(part)


def first_difference(part: Part) -> str:
    """Say in one line where the first wrong entry of a large array stands."""
    r, c = min(part.wrong)
    left, right = part.entries()
    index = f"[{r}]" if len(part.expected_shape) == 1 else f"[{r}, {c}]"
    row = part.rows[r] if part.rows[r] != f"x{r}" else ""
    where = f"{part.letter}{index}" + (f" ({row})" if row else "")
    entries = sum(len(line) for line in part.expected)
    return (
        f"{part.letter}: shape {part.expected_shape}, {len(part.wrong)} of {entries} entries wrong; "
        f"first {where}: got {left[r][c]}, expected {right[r][c]}"
    )


def _vector(part: Part) -> str:
    got, expected = _marked(part)
    table = [[part.letter, "got ", "expected"]]
    table += [[name, left[0], right[0]] for name, left, right in zip(part.rows, got, expected, strict=True)]
    head, *rest = aligned(table, [2, 3])
    return "\n".join([head + "   (wrong entries in brackets)", *rest])


def _matrix(part: Part) -> str:
    got, expected = _marked(part)
    n = len(part.columns)
    table = [[part.letter, *(f"{name} " for name in part.columns), *part.columns]]
    table += [[name, *left, *right] for name, left, right in zip(part.rows, got, expected, strict=True)]
    lines = aligned(table, [2] + [1] * (n - 1) + [4] + [1] * (n - 1))
    start = max(len(row[0]) for row in table) + 2
    middle = max(map(len, aligned([row[: n + 1] for row in table], [2] + [1] * (n - 1)))) + 4
    title = " " * start + "got".ljust(middle - start) + "expected   (wrong entries in brackets)"
    return "\n".join([title, *lines])


def _marked(part: Part) -> tuple[list[list[str]], list[list[str]]]:
    got, expected = part.entries()
    for r, row in enumerate(got):
        row[:] = [f"[{entry}]" if (r, c) in part.wrong else f"{entry} " for c, entry in enumerate(row)]
    return got, expected


def _fits(table: Sequence[Sequence[Any]], shape: tuple[int, ...]) -> bool:
    if len(shape) == 1:
        return len(table) <= _LONGEST_VECTOR
    return len(table) <= _LARGEST_MATRIX and all(len(row) <= _LARGEST_MATRIX for row in table)


def _whole(title: str, table: Sequence[Sequence[Any]], shape: tuple[int, ...]) -> str:
    if not table or not _fits(table, shape):
        return ""
    if len(shape) == 1:
        return f"\n  {title:8}  " + " ".join(number(row[0]) for row in table)
    lines = aligned([["", *map(number, row)] for row in table], [0] + [1] * (len(table[0]) - 1))
    return "\n  " + "\n            ".join([f"{title:8}  {lines[0]}", *lines[1:]])


def aligned(table: Sequence[Sequence[str]], gaps: Sequence[int]) -> list[str]:
    """Right-align every column but the first, with `gaps` blanks before each of the others."""
    widths = [max(len(row[k]) if k < len(row) else 0 for row in table) for k in range(len(gaps) + 1)]
    lines = []
    for row in table:
        line = row[0].ljust(widths[0])
        for cell, gap, width in zip(row[1:], gaps, widths[1:], strict=False):
            line += " " * gap + cell.rjust(width)
        lines.append(line.rstrip())
    return lines
