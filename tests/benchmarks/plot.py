"""Two plots on logarithmic scales, as SVG: bars, one for each grader, and lines over the size of a class."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

LEFT, WIDTH, ROW = 210, 420, 34
HEAD = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {} {}" font-family="sans-serif" font-size="13">'
GROUND = '<rect width="100%" height="100%" fill="#fff"/>'


def bars(seconds: Mapping[str, float]) -> str:
    """Draw CPU seconds a submission, one bar a grader.

    Examples
    --------
    >>> bars({"one": 0.01, "two": 1.0}).count("#4477aa")
    2
    """
    least, most = _decades(seconds.values())
    scale = WIDTH / (most - least)
    height = ROW * len(seconds) + 40
    parts = [
        HEAD.format(LEFT + WIDTH + 90, height),
        "<title>CPU seconds a submission, logarithmic scale</title>",
        GROUND,
    ]
    for power in range(least, most + 1):
        x = LEFT + (power - least) * scale
        parts.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="6" y2="{height - 30}" stroke="#ccc"/>')
        parts.append(f'<text x="{x:.1f}" y="{height - 12}" text-anchor="middle">{10.0**power:g} s</text>')
    for row, (name, value) in enumerate(seconds.items()):
        y, length = 8 + row * ROW, (math.log10(value) - least) * scale
        parts.append(f'<text x="{LEFT - 8}" y="{y + 17}" text-anchor="end">{name}</text>')
        parts.append(f'<rect x="{LEFT}" y="{y}" width="{length:.1f}" height="24" fill="#4477aa"/>')
        parts.append(f'<text x="{LEFT + length + 6:.1f}" y="{y + 17}">{value:.3g} s</text>')
    return "\n".join([*parts, "</svg>", ""])


@dataclass(frozen=True)
class Line:
    """One quantity over another."""

    name: str
    points: Sequence[tuple[float, float]]
    dashed: bool = False


def lines(title: str, along: str, drawn: Sequence[Line]) -> str:
    """Draw lines with a dot for each measured point, both axes logarithmic.

    Examples
    --------
    >>> lines("Growth", "n", [Line("time", [(10, 1.0), (100, 9.0)])]).count("<circle")
    2
    """
    left, bottom, width, height = 60, 300, 460, 270
    low_x, high_x = _decades(x for line in drawn for x, _ in line.points)
    low_y, high_y = _decades(y for line in drawn for _, y in line.points)

    def at(x: float, y: float) -> tuple[float, float]:
        right = left + width * (math.log10(x) - low_x) / (high_x - low_x)
        return right, bottom - height * (math.log10(y) - low_y) / (high_y - low_y)

    parts = [HEAD.format(left + width + 210, bottom + 50), f"<title>{title}, logarithmic scales</title>", GROUND]
    for power in range(low_x, high_x + 1):
        x, _ = at(10.0**power, 10.0**low_y)
        parts.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{bottom - height}" y2="{bottom}" stroke="#ccc"/>')
        parts.append(f'<text x="{x:.1f}" y="{bottom + 18}" text-anchor="middle">{10**power:,}</text>')
    for power in range(low_y, high_y + 1):
        _, y = at(10.0**low_x, 10.0**power)
        parts.append(f'<line x1="{left}" x2="{left + width}" y1="{y:.1f}" y2="{y:.1f}" stroke="#ccc"/>')
        parts.append(f'<text x="{left - 8}" y="{y + 4:.1f}" text-anchor="end">{10.0**power:g}</text>')
    parts.append(f'<text x="{left + width / 2}" y="{bottom + 40}" text-anchor="middle">{along}</text>')
    for line in drawn:
        places = [at(*point) for point in line.points]
        dash = ' stroke-dasharray="6 4"' if line.dashed else ""
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
        parts.append(f'<polyline points="{path}" fill="none" stroke="#4477aa" stroke-width="2"{dash}/>')
        parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="#4477aa"/>' for x, y in places]
        parts.append(f'<text x="{places[-1][0] + 10:.1f}" y="{places[-1][1] + 4:.1f}">{line.name}</text>')
    return "\n".join([*parts, "</svg>", ""])


def _decades(values: Iterable[float]) -> tuple[int, int]:
    """Return the powers of ten around some numbers."""
    found = list(values)
    low = math.floor(math.log10(min(found)) + 1e-9)
    return low, max(low + 1, math.ceil(math.log10(max(found)) - 1e-9))
