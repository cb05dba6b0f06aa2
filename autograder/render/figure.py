"""Pictures as small SVG texts: sharp on every screen, with a title and a description for screen readers.

Each picture has its own light ground and dark strokes, so that it is legible on paper and on a dark
page, and tells things apart by shape and pattern, not by colour. Only the standard library is needed:
the notebooks carry this file along, and students may run an older Python.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

__all__ = ["as_image", "bars", "curves", "in_words", "pose_graph", "spy", "svg"]

INK, GROUND, FILL, PALE = "#1b1b1b", "#fdfdfb", "#1f4e8c", "#e3e9f2"


def escape(words: str) -> str:
    """Write words so that they stand in XML as text."""
    return words.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").replace('"', "&quot;")


def in_words(picture: str) -> str:
    """Read title and description out of a picture, for those who cannot see it."""
    title, description = (picture.partition(f"<{tag}>")[2].partition(f"</{tag}>")[0] for tag in ("title", "desc"))
    words = f"{title}. {description}"
    for sign, name in (("<", "&lt;"), (">", "&gt;"), ('"', "&quot;"), ("&", "&amp;")):
        words = words.replace(name, sign)
    return words


def as_image(picture: str) -> str:
    """Write a picture as an HTML image with its words as alternative text: what is inside of an image is not read."""
    address = picture
    for sign in '%#&<>"\n':
        address = address.replace(sign, f"%{ord(sign):02X}")
    return f'<img alt="{escape(in_words(picture))}" src="data:image/svg+xml;charset=utf-8,{address}">'


def svg(width: float, height: float, title: str, description: str, parts: Sequence[str]) -> str:
    """Put parts on a light ground, with a title and a description."""
    size = f'viewBox="0 0 {width:g} {height:g}" width="{width:g}" height="{height:g}"'
    style = f'font-family="sans-serif" font-size="14" fill="{INK}"'
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" {size} role="img" {style}>',
        f"<title>{escape(title)}</title>",
        f"<desc>{escape(description)}</desc>",
        f'<rect width="{width:g}" height="{height:g}" rx="6" fill="{GROUND}"/>',
    ]
    return "\n".join([*lines, *parts, "</svg>", ""])


def _text(x: float, y: float, words: str, anchor: str = "middle") -> str:
    return f'<text x="{_(x)}" y="{_(y)}" text-anchor="{anchor}">{escape(words)}</text>'


def _line(path: str, more: str = "") -> str:
    return f'<path d="{path}" fill="none" stroke="{INK}" stroke-width="1.5"{more}/>'


def _(number: float) -> str:
    return f"{round(number, 1):g}"


def pose_graph(
    n_poses: int,
    edges: Sequence[tuple[int, int, float]],
    priors: Sequence[tuple[int, float]],
    landmarks: Sequence[int] = (),
) -> str:
    """Draw the poses of a graph in a row, landmarks as boxes, edges as arrows and arcs, priors as squares below.

    Parameters
    ----------
    n_poses : int
        Number of poses.
    edges : sequence of (i, j, measurement)
        The first edge between neighbours is a straight arrow, all others are dashed arcs.
    priors : sequence of (pose, mean)
        Drawn as a square that hangs on the pose.
    landmarks : sequence of int
        Unknowns that are no poses.

    Returns
    -------
    str
        The picture as SVG.
    """
    step, left = 120.0, 60.0
    at = [left + step * pose for pose in range(n_poses)]
    seen: dict[tuple[int, int], int] = {}
    arcs: list[tuple[int, int, float, float]] = []
    arrows: list[tuple[int, int, float]] = []
    for i, j, measured in edges:
        pair = (min(i, j), max(i, j))
        seen[pair] = seen.get(pair, -1) + 1
        if abs(i - j) == 1 and seen[pair] == 0:
            arrows.append((i, j, measured))
        else:
            arcs.append((i, j, measured, 26.0 + 26 * abs(i - j) + 34 * seen[pair]))
    top = 44.0 + max((height for *_rest, height in arcs), default=0.0)
    head = f'<path d="M0 0 L8 4 L0 8 z" fill="{INK}"/>'
    box = 'viewBox="0 0 8 8" refX="7" refY="4" markerWidth="8" markerHeight="8" orient="auto"'
    parts = [f'<defs><marker id="head" {box}>{head}</marker></defs>']
    for i, j, measured in arrows:
        towards = 1 if j > i else -1
        parts.append(_line(f"M{at[i] + 19 * towards:g} {top:g} H{at[j] - 20 * towards:g}", ' marker-end="url(#head)"'))
        parts.append(_text((at[i] + at[j]) / 2, top - 8, f"{measured:g} m"))
    for i, j, measured, height in arcs:
        towards = 1 if j > i else -1
        begin, end, peak = at[i] + 8 * towards, at[j] - 8 * towards, top - 17 - height * 4 / 3
        curve = f"M{begin:g} {top - 17:g} C{begin:g} {peak:g} {end:g} {peak:g} {end:g} {top - 18:g}"
        parts.append(_line(curve, ' stroke-dasharray="7 4" marker-end="url(#head)"'))
        parts.append(_text((at[i] + at[j]) / 2, top - 23 - height, f"{measured:g} m"))
    for pose, mean in priors:
        parts.append(_line(f"M{at[pose]:g} {top + 18:g} V{top + 46:g}"))
        parts.append(f'<rect x="{at[pose] - 6:g}" y="{top + 46:g}" width="12" height="12" fill="{INK}"/>')
        parts.append(_text(at[pose], top + 76, f"prior {mean:g} m"))
    for pose, x in enumerate(at):
        box = f'x="{x - 18:g}" y="{top - 18:g}" width="36" height="36" rx="{3 if pose in landmarks else 18}"'
        parts.append(f'<rect {box} fill="{PALE}" stroke="{FILL}" stroke-width="2"/>')
        parts.append(_text(x, top + 5, f"x{pose}"))
    words = [f"edge {i} to {j} measured {u:g} m" for i, j, u in edges]
    words += [f"prior on {pose} with mean {mean:g} m" for pose, mean in priors]
    words += [f"x{k} is a landmark, drawn as a box" for k in landmarks]
    title = f"Pose graph with {n_poses - len(landmarks)} poses" + (f" and {len(landmarks)} landmarks" * bool(landmarks))
    return svg(
        2 * left + step * (n_poses - 1),
        top + 92,
        title,
        f"Poses in the order of their numbers, not of place. {'; '.join(words)}.",
        parts,
    )


def spy(entries: Sequence[Sequence[float]], name: str, told: str = "") -> str:
    """Draw where a matrix is not 0: one filled square an entry, with its sign where some are negative.

    Parameters
    ----------
    entries : sequence of rows
        The matrix, as nested lists or an array.
    name : str
        What the matrix is called.
    told : str
        A sentence on the pattern, for those who cannot see a picture that is too large to be listed.

    Returns
    -------
    str
        The picture as SVG.
    """
    rows, columns = len(entries), len(entries[0])
    side = max(0.9, min(26.0, 360.0 / max(rows, columns)))
    left, top = 34.0, 40.0
    caption = f"{name}: {sum(entry != 0 for row in entries for entry in row)} of {rows * columns} entries"
    wide = side if side > 8 else max(side, min(8.0, 360.0 / columns))  # a tall matrix has flat entries, not hairs
    width, height = max(columns * wide, 8.0 * len(caption)) + 2 * left, rows * side + top + 20
    frame = f'width="{_(columns * wide)}" height="{_(rows * side)}"'
    parts = [f'<rect x="{left:g}" y="{top:g}" {frame} fill="white" stroke="{INK}"/>']
    filled = [(r, c) for r in range(rows) for c in range(columns) if entries[r][c] != 0]
    gap = 2.0 if side > 8 else 0.0
    across, down = _(wide - 2 * gap), _(side - 2 * gap)
    corners = [f"M{_(left + c * wide + gap)} {_(top + r * side + gap)}" for r, c in filled]
    squares = [f"{corner}h{across}v{down}h-{across}z" for corner in corners]
    edge = f' stroke="{FILL}"' if side < 2 else ""
    parts.append(f'<path d="{"".join(squares)}" fill="{FILL}"{edge}/>')
    if side > 14:
        parts += [_text(left + (c + 0.5) * side, top - 6, str(c)) for c in range(columns)]
        parts += [_text(left - 8, top + (r + 0.5) * side + 5, str(r), "end") for r in range(rows)]
    parts.append(_text(left, 18, caption, "start"))
    signed = any(entry < 0 for row in entries for entry in row)
    signs = {(r, c): "\u2212" if entries[r][c] < 0 else "+" for r, c in filled if signed}
    if side > 14:
        places = [(left + (c + 0.5) * side, top + (r + 0.5) * side + 6, sign) for (r, c), sign in signs.items()]
        parts += [_text(x, y, sign).replace("<text", '<text fill="white" font-weight="bold"') for x, y, sign in places]
    words = {at: f"{at[1]} ({signs[at]})" if signed else str(at[1]) for at in filled}
    listed = "; ".join(f"row {r}: columns {', '.join(words[at] for at in filled if at[0] == r)}" for r in range(rows))
    description = f"{rows} rows, {columns} columns." + (f" Not 0 in {listed}." if rows <= 12 else "")
    description += f" {told}" if told else ""
    return svg(width, height, caption, description, parts)


def bars(
    title: str,
    names: Sequence[str],
    before: Sequence[float],
    after: Sequence[float],
    words: tuple[str, str] = ("before", "after"),
) -> str:
    """Draw two values for each name: before as a hollow bar, after as a filled one, with the numbers.

    Parameters
    ----------
    title : str
        Says what is shown, with its unit.
    names : sequence of str
        One a pair of bars.
    before, after : sequence of float
        The values.
    words : (str, str)
        What the two are called.

    Returns
    -------
    str
        The picture as SVG.
    """
    size = max(abs(value) for value in [*before, *after])
    before, after = ([0.0 if abs(v) <= 1e-9 * size else v for v in values] for values in (before, after))
    values = [*before, *after, 0.0]
    low, high = min(values), max(values)
    scale = 280.0 / (high - low or 1.0)
    zero, top = 230.0 - low * scale, 62.0
    height = top + 40 * len(names) + 8
    parts = [_text(20, 22, title, "start")]
    for left, fill, word in ((20, "white", words[0]), (60 + 8 * len(words[0]), FILL, words[1])):
        parts.append(
            f'<rect x="{left}" y="34" width="18" height="11" fill="{fill}" stroke="{FILL}" stroke-width="1.5"/>'
        )
        parts.append(_text(left + 25, 44, word, "start"))
    parts.append(_line(f"M{_(zero)} {top - 6:g} V{height - 6:g}"))
    pairs = list(zip(names, before, after))  # noqa: B905 - students may run a Python without strict
    for index, (name, one, two) in enumerate(pairs):
        y = top + 40 * index
        parts.append(_text(20, y + 20, name, "start"))
        for offset, value, fill in ((0.0, one, "white"), (15.0, two, FILL)):
            x, width = zero + min(value, 0.0) * scale, abs(value) * scale
            if width >= 0.05:
                box = f'x="{_(x)}" y="{_(y + offset)}" width="{_(width)}" height="12"'
                parts.append(f'<rect {box} fill="{fill}" stroke="{FILL}" stroke-width="1.5"/>')
            beside, anchor = (x - 8, "end") if value < 0 else (x + width + 8, "start")
            parts.append(_text(beside, y + offset + 11, f"{value:.4g}", anchor))
    told = "; ".join(f"{name}: {words[0]} {one:.4g}, {words[1]} {two:.4g}" for name, one, two in pairs)
    return svg(600, height, title, told + ".", parts)


def curves(
    title: str,
    across: str,
    up: str,
    series: Mapping[str, Sequence[tuple[float, float]]],
    log_x: bool = False,
    log_y: bool = True,
) -> str:
    """Draw up to three curves, each with a mark and a dash pattern of its own.

    Parameters
    ----------
    title, across, up : str
        What is shown, and the names of the two axes with their units.
    series : mapping of name to points (x, y)
        A point with y <= 0 has no logarithm: it is drawn on the bottom line, which is then marked 0.
    log_x, log_y : bool
        Whether the horizontal and the vertical axis are logarithmic.

    Returns
    -------
    str
        The picture as SVG.
    """
    points = [point for curve in series.values() for point in curve]
    levels = [math.log10(y) if log_y else y for _x, y in points if y > 0 or not log_y]
    nothing = log_y and min(y for _x, y in points) <= 0
    low = math.floor(min(levels) + 1e-9) - 1.0 if nothing else min(levels) - 0.15
    high = math.ceil(max(levels) - 1e-9) + (not log_y and max(levels) == min(levels))
    xs = sorted({x for x, _y in points})
    place = {x: math.log10(x) if log_x else float(x) for x in xs}
    span = place[xs[-1]] - place[xs[0]] or 1.0
    left, right, top, bottom = 84.0, 470.0, 44.0, 284.0

    def spot(x: float, y: float) -> tuple[float, float]:
        level = y if not log_y else math.log10(y) if y > 0 else low
        part = (max(level, low) - low) / (high - low)
        return left + (right - left) * (place[x] - place[xs[0]]) / span, bottom - (bottom - top) * part

    parts = [_text(20, 24, title, "start"), _line(f"M{left:g} {top:g} V{bottom:g} H{right:g}")]
    for decade in range(math.ceil(low), high + 1, max(1, int(high - low) // 6)):
        y = bottom - (bottom - top) * (decade - low) / (high - low)
        parts.append(f'<path d="M{left:g} {_(y)} H{right:g}" stroke="#c9c9c9" stroke-width="0.7"/>')
        parts.append(
            _text(left - 8, y + 5, "0" if nothing and decade == low else f"1e{decade}" if log_y else f"{decade}", "end")
        )
    parts += [_text(spot(x, 1.0)[0], bottom + 20, f"{x:g}") for x in xs]
    parts.append(_text((left + right) / 2, bottom + 42, across))
    parts.append(f'<text transform="translate(22 {(top + bottom) / 2:g}) rotate(-90)" text-anchor="middle">{up}</text>')
    for index, (name, curve) in enumerate(series.items()):
        drawn = [spot(x, y) for x, y in curve]
        path = "M" + " L".join(f"{_(x)} {_(y)}" for x, y in drawn)
        parts.append(_line(path, ("", ' stroke-dasharray="7 4"', ' stroke-dasharray="2 3"')[min(index, 2)]))
        parts += [_mark(x, y, index) for x, y in drawn]
        key = top + 10 + 24 * index
        parts += [_mark(right + 24, key, index), _text(right + 38, key + 5, name, "start")]
    told = [f"{name}: " + ", ".join(f"{y:.2g} at {x:g}" for x, y in curve) for name, curve in series.items()]
    return svg(660, bottom + 56, title, f"{up} over {across}. {'; '.join(told)}.", parts)


def _mark(x: float, y: float, kind: int) -> str:
    if kind > 1:
        return f'<path d="M{_(x)} {_(y - 6)} l6 10 h-12 z" fill="white" stroke="{FILL}" stroke-width="2"/>'
    if kind:
        box = f'x="{_(x - 5)}" y="{_(y - 5)}" width="10" height="10"'
        return f'<rect {box} fill="white" stroke="{FILL}" stroke-width="2"/>'
    return f'<circle cx="{_(x)}" cy="{_(y)}" r="5" fill="{FILL}"/>'
