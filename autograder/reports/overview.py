"""The page of the class: how hard each stage was, who shares a mistake, what was unusual."""

from __future__ import annotations

import statistics
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any
from urllib.parse import quote

from autograder.reports.charts import histogram
from autograder.reports.counterexample import counterexample_text
from autograder.reports.html import page
from autograder.reports.summary import Trouble, stage_names, stage_summaries, troubles, waiting
from autograder.reports.wording import MARKS, points
from autograder.verdicts import Result, StageVerdict

_MOST_GROUPS = 30
_WITNESSES = 3
_NOTHING: Mapping[str, Any] = {
    "interrupted": False,
    "confinement": "",
    "locks": "",
    "seed": None,
    "examples": None,
    "exam": "",
    "versions": {},
}


@dataclass(frozen=True)
class Cell:
    """One submission in one stage: a shade by share, and the mark in words."""

    text: str
    key: str
    shade: str


@dataclass(frozen=True)
class Row:
    """One submission in the class table."""

    result: Result
    link: str
    cells: tuple[Cell, ...]


def class_page(results: Sequence[Result], record: Mapping[str, Any], course: str = "1D SLAM") -> str:
    """Write the page of the class.

    Parameters
    ----------
    results : sequence of Result
        All submissions, sorted.
    record : mapping
        What run.json holds; whatever is missing is left out.
    course : str
        Title of the homework.
    """
    names = stage_names(results)
    scores = [result.score for result in results if result.status == "graded" and result.score is not None]
    most = max((result.max_score for result in results), default=0.0)
    listed = troubles(results)
    return page(
        "report.html.j2",
        course=course,
        record={**_NOTHING, **record},
        stages=names,
        rows=[_row(result, names) for result in results],
        scores=scores,
        mean=statistics.fmean(scores) if scores else None,
        median=statistics.median(scores) if scores else None,
        most=most,
        histogram=histogram(scores, most),
        summaries=sorted(stage_summaries(results), key=lambda s: s.mean / s.max_score if s.max_score else 1.0),
        groups=[_group(trouble, results) for trouble in listed[:_MOST_GROUPS]],
        more_groups=len(listed[_MOST_GROUPS:]),
        nobody=nobody_passed(results),
        unusual=unusual(results),
        provisional=waiting(results),
        flagged=[(one.submission, link(one.submission), one.flags) for one in results if one.flags],
        legend=[(MARKS[s][0], MARKS[s][1]) for s in MARKS if MARKS[s][0] and _used(results, s)],
    )


def _group(trouble: Trouble, results: Sequence[Result]) -> tuple[Trouble, list[tuple[str, str]], str]:
    """Give a group its first members and, where one of them has it, the case that shows the mistake."""
    members = [result for result in results if result.submission in set(trouble.submissions[:_WITNESSES])]
    name = trouble.stage.partition(" ")[0]
    shown = (
        check.counterexample
        for result in members
        for stage in result.stages
        if stage.name == name
        for check in stage.checks
        if not check.passed and check.counterexample
    )
    witness = next((counterexample_text(example) for example in shown if example), "")
    return trouble, [(name, link(name)) for name in trouble.submissions[:_WITNESSES]], witness


def nobody_passed(results: Sequence[Result]) -> list[tuple[str, str, int]]:
    """List the checks that no graded submission passed: stage, check, how many tried."""
    tried: dict[tuple[str, str], list[bool]] = {}
    for result in results:
        for stage in result.stages:
            for check in stage.checks:
                tried.setdefault((stage.name, check.name), []).append(check.passed)
    return [(stage, check, len(passed)) for (stage, check), passed in tried.items() if not any(passed)]


def unusual(results: Sequence[Result]) -> list[tuple[str, list[tuple[str, str]]]]:
    """List runs that a grader should look at: what happened, and to whom."""
    found: dict[str, list[tuple[str, str]]] = {}
    for result in results:
        events = []
        if result.status == "grader_error":
            events.append("could not be graded, through no fault of the student")
        elif result.status == "rejected":
            events.append("could not be read")
        statuses = {stage.status for stage in result.stages}
        events += [MARKS[status][1] for status in ("timeout", "memory", "forbidden") if status in statuses]
        for event in events:
            found.setdefault(event, []).append((result.submission, link(result.submission)))
    return sorted(found.items())


def link(submission: str) -> str:
    """Where the page of a submission lies, seen from the class page.

    Examples
    --------
    >>> link("zoë #1")
    'feedback/zo%C3%AB%20%231.html'
    """
    return f"feedback/{quote(submission, safe='')}.html"


def _row(result: Result, names: Sequence[str]) -> Row:
    by_name = {stage.name: stage for stage in result.stages}
    return Row(result, link(result.submission), tuple(_cell(by_name.get(name)) for name in names))


def _cell(stage: StageVerdict | None) -> Cell:
    if stage is None:
        return Cell("", "", "")
    share = stage.score / stage.max_score if stage.max_score else 0.0
    shade = "full" if stage.status == "passed" else ("some" if share > 0 else "none")
    if stage.status == "awaiting_mark":
        shade = ""
    return Cell(f"{points(stage.score)} {MARKS[stage.status][0]}".strip(), points(stage.score), shade)


def _used(results: Sequence[Result], status: str) -> bool:
    return any(stage.status == status for result in results for stage in result.stages)
