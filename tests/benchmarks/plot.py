"""Bars on a logarithmic scale, as SVG."""

from __future__ import annotations

import math
from collections.abc import Mapping

LEFT, WIDTH, ROW = 150, 420, 34


def bars(seconds: Mapping[str, float]) -> str:
    """Draw CPU seconds a submission, one bar a grader.

    Examples
    --------
    >>> bars({"one": 0.01, "two": 1.0}).count("<rect")
    2
    """
    least = math.floor(math.log10(min(seconds.values())))
    most = math.ceil(math.log10(max(seconds.values())) + 1e-9)
    scale = WIDTH / max(most - least, 1)
    height = ROW * len(seconds) + 40
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {LEFT + WIDTH + 90} {height}" font-family="sans-serif" '
        'font-size="13"><title>CPU seconds a submission, logarithmic scale</title>'
    )
    parts = [head]
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
