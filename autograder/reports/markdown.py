"""The class as markdown, for a forum post: means and mistakes, and nobody's name or mark."""

from __future__ import annotations

import re
from collections.abc import Sequence

from autograder.reports.counterexample import counterexample_text
from autograder.reports.summary import mean_score, most_instructive, reason, stage_summaries, troubles, waiting
from autograder.reports.wording import plural, points, visible
from autograder.verdicts import Result

_SMALLEST_GROUP = 2  # a mistake that only one made would name its maker to those who know them


def class_markdown(results: Sequence[Result], course: str = "1D SLAM", most: int = 8) -> str:
    """Write what a class may read about itself."""
    graded = sum(result.status == "graded" for result in results)
    mean = mean_score(results)
    top = max((result.max_score for result in results), default=0.0)
    lines = [f"## {escaped(course)}: how it went", ""]
    lines.append(
        f"{plural(graded, 'submission')} graded."
        if mean is None
        else f"{plural(graded, 'submission')} graded, {points(mean)} of {points(top)} points on average."
    )
    if said := waiting(results):
        lines += ["", f"These marks are {said}."]
    lines += ["", "| stage | mean | full points |", "|---|---:|---:|"]
    lines += [
        f"| `{s.name}` | {points(s.mean)} of {points(s.max_score)} | {s.passed} of {s.graded} |"
        for s in stage_summaries(results)
    ]
    shared = [trouble for trouble in troubles(results) if trouble.slip and trouble.count >= _SMALLEST_GROUP]
    if shared:
        hints = {(v.name, v.slip or ""): v.hint for result in results for v in result.stages}
        lines += ["", "### What went wrong most", ""]
        for trouble in shared[:most]:
            stage = trouble.stage.partition(" ")[0]
            hint = hints.get((stage, trouble.slip or ""), "")
            told = f" {escaped(hint)}" if hint else ""
            lines.append(f"- {trouble.count} times in `{stage}`: {escaped(trouble.reason)}.{told}")
        lines += _example(results, shared[0].slip)
    return "\n".join(lines) + "\n"


def escaped(text: str) -> str:
    r"""Keep foreign text from being read as markdown or HTML.

    Examples
    --------
    >>> escaped("J[0, 1] <b>")
    'J\\[0, 1\\] \\<b\\>'
    """
    return re.sub(r"([\\`*_{}\[\]<>#|!~&])", r"\\\1", visible(text))


def _example(results: Sequence[Result], slip: str | None) -> list[str]:
    """Show the counterexample of the most frequent mistake: it is the grader's case, nobody's secret."""
    with_slip = [result for result in results if any(stage.slip == slip for stage in result.stages)]
    picked = most_instructive(with_slip)
    if picked is None or picked[1].slip != slip:
        return []
    return ["", f"For example, {escaped(reason(picked[1]))}:", "", "```", counterexample_text(picked[2]), "```"]
