"""A pose graph as a few lines of text: the poses on a line, the other factors as arcs below."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from autograder.reports.wording import number

LARGEST = 8
_WIDTH = 76


def picture(graph: Mapping[str, Any]) -> str:
    """Draw a graph of up to 8 poses; a larger one, or one with long numbers, is listed instead.

    Examples
    --------
    >>> print(picture({"n_poses": 3, "edges": [[0, 1], [1, 2], [0, 2]], "measurements": [1, 1.5, 2],
    ...                "priors": [0], "prior_means": [0]}))
           1            1.5
    x0 ---------> x1 ---------> x2
    o------------ 2 ------------>
    ^ prior, mean 0
    """
    n = int(graph.get("n_poses", 0))
    edges = [(int(i), int(j), number(u)) for (i, j), u in zip(graph["edges"], graph["measurements"], strict=True)]
    needed = max([4, *(len(u) + 1 for i, j, u in edges if abs(i - j) == 1)])
    gap = min(10, (_WIDTH - 2 * n) // max(n - 1, 1) - 2)
    if n > LARGEST or gap < needed:
        return _listing(n, edges, graph)
    step = gap + 4
    chain, arcs = _split(edges)
    above, line = "", ""
    for left in range(n):
        line += f"x{left}".ljust(2)
        if left + 1 < n:
            forward, label = chain.get(left, (True, ""))
            above = above.ljust(left * step + 2) + label.center(step - 2)
            line += " " + _arrow(gap, forward) + " " if left in chain else " " * (gap + 2)
    rows = [above.rstrip(), line.rstrip()] if above.strip() else [line.rstrip()]
    rows += [_arc(i * step, j * step, label) for i, j, label in arcs]
    for pose, mean in zip(graph.get("priors", ()), graph.get("prior_means", ()), strict=True):
        rows.append(" " * (int(pose) * step) + f"^ prior, mean {number(mean)}")
    return "\n".join(rows)


def _split(edges: list[tuple[int, int, str]]) -> tuple[dict[int, tuple[bool, str]], list[tuple[int, int, str]]]:
    """Draw the first edge between neighbours on the line, every other one below it."""
    chain: dict[int, tuple[bool, str]] = {}
    arcs: list[tuple[int, int, str]] = []
    for i, j, label in edges:
        if abs(i - j) == 1 and min(i, j) not in chain:
            chain[min(i, j)] = (i < j, label)
        else:
            arcs.append((i, j, label))
    return chain, arcs


def _arrow(width: int, forward: bool) -> str:
    return "-" * (width - 1) + ">" if forward else "<" + "-" * (width - 1)


def _arc(start: int, end: int, label: str) -> str:
    left, right = min(start, end), max(start, end)
    body = f" {label} ".center(right - left - 1, "-")
    ends = ("o", ">") if start < end else ("<", "o")
    return " " * left + ends[0] + body + ends[1]


def _listing(n: int, edges: list[tuple[int, int, str]], graph: Mapping[str, Any]) -> str:
    priors = list(zip(graph.get("priors", ()), graph.get("prior_means", ()), strict=True))
    rows = [f"{n} poses, {len(edges)} edges, {len(priors)} priors"]
    shown = [f"{i} -> {j}: {u}" for i, j, u in edges] + [f"prior {k}: {number(mean)}" for k, mean in priors]
    if len(shown) > 24:
        shown = [*shown[:24], f"and {len(shown) - 24} more"]
    line = ""
    for item in shown:
        if line and len(line) + len(item) + 2 > _WIDTH:
            rows.append(line + ",")
            line = ""
        line += (", " if line else "") + item
    return "\n".join([*rows, line])
