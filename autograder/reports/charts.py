"""Small SVG charts that only reports need; colours come from the page's style sheet, so dark mode holds."""

from __future__ import annotations

from collections.abc import Sequence

from markupsafe import Markup

from autograder.reports.wording import plural, points

_BAR = Markup(
    '<svg class="bar" viewBox="0 0 100 10" preserveAspectRatio="none" role="img" aria-label="{words}">'
    "<title>{words}</title>"
    '<rect class="track" width="100" height="10" rx="1"/>'
    '<rect class="{kind}" width="{width}" height="10" rx="1"/></svg>'
)


def bar(value: float, most: float, kind: str = "got") -> Markup:
    """Draw a share of a whole as a filled bar.

    Examples
    --------
    >>> 'width="50"' in bar(7.5, 15.0) and "7.5 of 15" in bar(7.5, 15.0)
    True
    """
    share = min(max(value / most, 0.0), 1.0) if most > 0 else 0.0
    return _BAR.format(words=f"{points(value)} of {points(most)}", kind=kind, width=f"{100 * share:.4g}")


def histogram(scores: Sequence[float], most: float, bins: int = 10) -> Markup:
    """Draw how many scores fall into each of `bins` equal parts of 0 .. `most`; scores above it join the last."""
    counts = [0] * bins
    for score in scores:
        counts[min(max(int(score / most * bins), 0), bins - 1) if most > 0 else 0] += 1
    edges = [most * k / bins for k in range(bins + 1)]
    tallest = max([*counts, 1])
    width, height, base = 46.0, 120.0, 150.0
    parts = []
    for k, count in enumerate(counts):
        tall = height * count / tallest
        x = 10 + k * width
        parts.append(
            Markup('<rect class="got" x="{}" y="{}" width="{}" height="{}" rx="2"/>').format(
                f"{x + 2:g}", f"{base - tall:g}", f"{width - 4:g}", f"{max(tall, 1):g}"
            )
        )
        parts.append(
            Markup('<text x="{}" y="{}" text-anchor="middle">{}</text>').format(
                f"{x + width / 2:g}", f"{base - tall - 5:g}", count
            )
        )
    for k, edge in enumerate(edges):
        parts.append(
            Markup('<text class="axis" x="{}" y="{}" text-anchor="middle">{}</text>').format(
                f"{10 + k * width:g}", f"{base + 18:g}", points(round(edge, 1))
            )
        )
    told = "; ".join(
        f"{points(round(low, 1))} to {points(round(high, 1))}: {count}"
        for low, high, count in zip(edges, edges[1:], counts, strict=False)
    )
    return Markup(
        '<svg class="histogram" viewBox="0 0 {} 176" role="img" aria-label="{}">'
        "<title>{}</title><desc>{}.</desc>{}</svg>"
    ).format(
        f"{20 + bins * width:g}",
        f"Distribution of {plural(len(scores), 'score')}: {told}",
        f"Distribution of {plural(len(scores), 'score')}",
        told,
        Markup("").join(parts),
    )
