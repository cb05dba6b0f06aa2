"""Pictures as small SVG texts: sharp on every screen, with a title and a description for screen readers.

Each picture has its own light ground and dark strokes, so that it is legible on paper and on a dark page.
"""

from collections.abc import Sequence
from xml.sax.saxutils import escape

__all__ = ["pose_graph"]

INK, GROUND, ACCENT, QUIET = "#1b1b1b", "#fdfdfb", "#0b5394", "#9a9a9a"

_HEAD = (
    '<defs><marker id="head" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="8" markerHeight="8" orient="auto">'
    f'<path d="M0 0 L8 4 L0 8 z" fill="{INK}"/></marker></defs>'
)


def _svg(width: float, height: float, title: str, description: str, parts: Sequence[str]) -> str:
    """Wrap the parts of a picture."""
    size = f'viewBox="0 0 {width:g} {height:g}" width="{width:g}" height="{height:g}"'
    style = f'font-family="sans-serif" font-size="14" fill="{INK}"'
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" {size} role="img" {style}>',
            f"<title>{escape(title)}</title>",
            f"<desc>{escape(description)}</desc>",
            f'<rect width="{width:g}" height="{height:g}" rx="6" fill="{GROUND}"/>',
            *parts,
            "</svg>",
            "",
        ]
    )


def _text(x: float, y: float, words: str, more: str = "") -> str:
    return f'<text x="{x:g}" y="{y:g}" text-anchor="middle"{more}>{escape(words)}</text>'


def pose_graph(
    n_poses: int,
    edges: Sequence[tuple[int, int, float]],
    priors: Sequence[tuple[int, float]],
) -> str:
    """Draw the poses of a graph in a row, its edges as lines and arcs, its priors as squares below.

    Parameters
    ----------
    n_poses : int
        Number of poses.
    edges : sequence of (i, j, measurement)
        Neighbours are joined by a straight arrow, others by an arc whose height grows with its span.
    priors : sequence of (pose, mean)
        Drawn as a square that hangs on the pose.

    Returns
    -------
    str
        The picture as SVG.
    """
    step, left = 120.0, 60.0
    spans = [abs(i - j) for i, j, _ in edges if abs(i - j) > 1]
    top = 40.0 + 34.0 * max(spans, default=0)
    at = [left + step * pose for pose in range(n_poses)]
    parts = [_HEAD]
    seen: dict[tuple[int, int], int] = {}
    for i, j, measured in edges:
        pair = (min(i, j), max(i, j))
        seen[pair] = seen.get(pair, -1) + 1
        towards = 1.0 if j > i else -1.0
        middle = (at[i] + at[j]) / 2
        if abs(i - j) == 1 and seen[pair] == 0:
            parts.append(_arrow(f"M{at[i] + 20 * towards:g} {top:g} H{at[j] - 20 * towards:g}"))
            parts.append(_text(middle, top - 8, f"{measured:g} m"))
        else:
            height = 62.0 * abs(i - j) + 40 * seen[pair]
            begin, end = at[i] + 12 * towards, at[j] - 12 * towards
            parts.append(
                _arrow(f"M{begin:g} {top - 16:g} Q{middle:g} {top - 16 - height:g} {end:g} {top - 17:g}", dashed=True)
            )
            parts.append(_text(middle, top - 22 - height / 2, f"{measured:g} m"))
    for pose, mean in priors:
        parts.append(f'<path d="M{at[pose]:g} {top + 18:g} V{top + 46:g}" stroke="{INK}" stroke-width="1.5"/>')
        parts.append(f'<rect x="{at[pose] - 6:g}" y="{top + 46:g}" width="12" height="12" fill="{INK}"/>')
        parts.append(_text(at[pose], top + 76, f"prior {mean:g} m"))
    for pose, x in enumerate(at):
        parts.append(f'<circle cx="{x:g}" cy="{top:g}" r="18" fill="#e8eef7" stroke="{ACCENT}" stroke-width="2"/>')
        parts.append(_text(x, top + 5, f"x{pose}"))
    words = [f"{i} to {j} measured {u:g} m" for i, j, u in edges]
    words += [f"prior on {pose} with mean {mean:g} m" for pose, mean in priors]
    description = f"{n_poses} poses in a row. " + "; ".join(words) + "."
    return _svg(2 * left + step * (n_poses - 1), top + 92, f"Pose graph with {n_poses} poses", description, parts)


def _arrow(path: str, dashed: bool = False) -> str:
    dashes = ' stroke-dasharray="6 4"' if dashed else ""
    return f'<path d="{path}" fill="none" stroke="{INK}" stroke-width="1.5"{dashes} marker-end="url(#head)"/>'
