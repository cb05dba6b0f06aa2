"""The class in a terminal: a line a submission, the means, and what went wrong most.

Laid out by hand rather than by a table widget, because a rejected submission has a sentence where the
others have marks. Without colour and through a pipe the same characters come out.
"""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Sequence
from typing import TextIO

from rich.console import Console
from rich.text import Text

from autograder.reports.apart import apart
from autograder.reports.summary import StageSummary, mean_score, stage_names, stage_summaries, troubles, waiting
from autograder.reports.wording import MARKS, plural, points, visible
from autograder.verdicts import Result, StageVerdict

_STYLES = {"": "green", "~": "yellow", "?": "cyan", ".": "dim"}
_NAMES_AT_LEAST = 8
_NAMES_AT_MOST = 28


def console(file: TextIO | None = None, width: int | None = None) -> Console:
    """Open a console that never wraps nor marks up what it is given; plain text where no terminal is."""
    return Console(file=file, width=width, highlight=False, markup=False, emoji=False, soft_wrap=True)


def print_class(results: Sequence[Result], to: Console) -> None:
    """Print the table, the class means, the legend and what went wrong most."""
    if not results:
        return
    for line in class_table(results, to.width):
        to.print(line)
    if said := waiting(results):
        to.print(Text(f"{said}.", style="cyan"))
    for line in [*not_graded(results, to.width), *flagged(results, to.width)]:
        to.print(line)
    listed = went_wrong(results, to.width)
    if listed:
        to.print()
        for line in listed:
            to.print(line)


def class_table(results: Sequence[Result], width: int) -> list[Text]:
    """Lay out a line a submission with a mark a stage, then the means over those graded."""
    stages = stage_names(results)
    heads, key = _headings(stages, width)
    cells = {r.submission: [_mark(r, name) for name in stages] for r in results}
    widths = [
        max([len(line) for line in head] + [len(row[k]) for row in cells.values()] + [4])
        for k, head in enumerate(heads)
    ]
    longest = max([len(visible(r.submission)) for r in results] + [10])
    status = max([len(r.status) for r in results] + [len("status")])
    room = width - sum(widths) - len(widths) - status - 2 - 8
    ids = [r.submission for r in results]
    name_width = max(_NAMES_AT_LEAST, min(longest, room, _NAMES_AT_MOST))
    name_width = max([name_width, *map(len, apart(ids, name_width).values())])
    names = apart(ids, name_width)
    marks_width = sum(widths) + len(widths)

    lines = []
    depth = max([len(head) for head in heads] + [1])
    for level in range(depth):
        last = level == depth - 1
        line = Text(("submission" if last else "").ljust(name_width)[:name_width])
        for head, wide in zip(heads, widths, strict=True):
            shifted = level - (depth - len(head))
            line.append(" " + (head[shifted] if shifted >= 0 else "").rjust(wide))
        line.append(f"  {'status' if last else '':{status}}{'total' if last else '':>8}")
        line.rstrip()
        line.stylize("bold")
        lines.append(line)
    lines.append(_rule(name_width + marks_width + status + 10))
    for result in results:
        line = Text(names[result.submission].ljust(name_width))
        if result.status == "graded":
            for cell, name, wide in zip(cells[result.submission], stages, widths, strict=True):
                line.append(" " + cell.rjust(wide), style=_style(result, name))
        else:
            said = visible(result.message, marks_width - 1) if marks_width > 4 else ""
            line.append((" " + said).ljust(marks_width), style="red")
        total = "--" if result.score is None else points(result.score)
        line.append(f"  {result.status:{status}}")
        line.append(f"{total:>8}", style="bold")
        lines.append(line)
    lines.append(_rule(name_width + marks_width + status + 10))
    lines += _means(results, stages, widths, name_width, status)
    return [*lines, *key, *_legend(results, width)]


def not_graded(results: Sequence[Result], width: int, most: int = 8) -> list[Text]:
    """Give the whole reason of each submission without marks; the table has room for its beginning only."""
    reasons = [
        f"{visible(result.submission)}: {visible(result.message)}"
        for result in results
        if result.status != "graded" and result.message
    ]
    return _listed("Not graded", reasons, width, most)


def flagged(results: Sequence[Result], width: int, most: int = 8) -> list[Text]:
    """List what only staff should see, such as the numbers of somebody else."""
    remarks = [f"{visible(one.submission)}: {visible(' '.join(one.flags))}" for one in results if one.flags]
    return _listed("For a human to look at", remarks, width, most)


def _listed(title: str, remarks: Sequence[str], width: int, most: int) -> list[Text]:
    if not remarks:
        return []
    lines = [Text(), Text(title, style="bold")]
    for remark in remarks[:most]:
        lines += [Text(line) for line in textwrap.wrap(remark, width, initial_indent="  ", subsequent_indent="    ")]
    if len(remarks) > most:
        lines.append(Text(f"  and {len(remarks) - most} more, see results/", style="dim"))
    return lines


def went_wrong(results: Sequence[Result], width: int, most: int = 10) -> list[Text]:
    """List the most frequent reasons for lost points: stage, slip or message, count."""
    listed = troubles(results)
    if not listed:
        return []
    wide = max(len(t.stage) for t in listed[:most])
    lines = [Text("What went wrong most", style="bold")]
    for trouble in listed[:most]:
        line = Text(f"{trouble.count:5}  {trouble.stage:{wide}}  ")
        line.append(visible(trouble.reason, max(width - wide - 9, 20)))
        lines.append(line)
    rest = listed[most:]
    if rest:
        lines.append(Text(f"{sum(t.count for t in rest):5}  in {plural(len(rest), 'other group')}", style="dim"))
    return lines


def _verdict(result: Result, name: str) -> StageVerdict | None:
    return next((stage for stage in result.stages if stage.name == name), None)


def _mark(result: Result, name: str) -> str:
    stage = _verdict(result, name)
    if stage is None:
        return ""
    symbol = MARKS[stage.status][0]
    return f"{points(stage.score)} {symbol}" if symbol else f"{points(stage.score)}  "


def _style(result: Result, name: str) -> str:
    stage = _verdict(result, name)
    return _STYLES.get(MARKS[stage.status][0], "red") if stage else ""


def _headings(stages: Sequence[str], width: int) -> tuple[list[list[str]], list[Text]]:
    """Stage names, a word a line; cut words, or letters with a key below, where that is too wide."""
    for longest in (20, 8):
        heads = [[w if len(w) <= longest else w[:5] + "." for w in name.split("_")] for name in stages]
        taken = sum(max([len(word) for word in head] + [4]) + 1 for head in heads)
        if taken + 14 + 18 <= width:
            return heads, []
    letters = [[f"({chr(ord('a') + k)})"] for k in range(len(stages))]
    key = [f"{letter[0]} {name}" for letter, name in zip(letters, stages, strict=True)]
    return letters, [Text(line) for line in _wrapped(key, width)]


def _means(
    results: Sequence[Result],
    stages: Sequence[str],
    widths: Sequence[int],
    name_width: int,
    status: int,
) -> list[Text]:
    summaries = {summary.name: summary for summary in stage_summaries(results)}
    graded = sum(result.status == "graded" for result in results)
    mean = mean_score(results)
    most = max((result.max_score for result in results), default=0.0)
    rows: tuple[tuple[str, Callable[[StageSummary], str], str, str], ...] = (
        ("mean", lambda s: f"{s.mean:.1f}", f"of {graded}", "--" if mean is None else f"{mean:.1f}"),
        ("of", lambda s: points(s.max_score), "", points(most)),
        ("complete", lambda s: str(s.passed), "", ""),
    )
    lines = []
    for name, cell, middle, total in rows:
        line = Text(name.ljust(name_width)[:name_width])
        for stage, wide in zip(stages, widths, strict=True):
            shown = cell(summaries[stage]) + "  " if stage in summaries else ""
            line.append(" " + (shown if len(shown) <= wide else shown.rstrip()).rjust(wide))
        line.append(f"  {middle:{status}}{total:>8}")
        line.rstrip()
        lines.append(line)
    return lines


def _legend(results: Sequence[Result], width: int) -> list[Text]:
    used = {stage.status for result in results for stage in result.stages}
    key = [f"{symbol} {words}" for status, (symbol, words) in MARKS.items() if symbol and status in used]
    lines = [Text("marks: " + line if k == 0 else "       " + line) for k, line in enumerate(_wrapped(key, width - 7))]
    return [line for line in lines if line.plain.strip() != "marks:"]


def _rule(width: int) -> Text:
    return Text("-" * width, style="dim")


def _wrapped(items: Sequence[str], width: int) -> list[str]:
    lines = [""]
    for item in items:
        if lines[-1] and len(lines[-1]) + len(item) + 3 > width:
            lines[-1] += ","
            lines.append("")
        lines[-1] += (", " if lines[-1] else "") + item
    return lines
