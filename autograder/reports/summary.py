"""What a class of results says, as numbers: means, and what went wrong most; every report shows these."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from autograder.reports.wording import MARKS, points, visible
from autograder.verdicts import Result, StageVerdict

# Two messages that differ in their numbers only tell of one mistake.
_NUMBERS = re.compile(r"-?\d[\d.]*(e-?\d+)?")
FULL = ("passed", "awaiting_mark")


@dataclass(frozen=True)
class StageSummary:
    """One stage over the class: its mean and how many have all of it, of those graded."""

    name: str
    max_score: float
    mean: float
    passed: int
    graded: int
    bonus: bool = False


@dataclass(frozen=True)
class Trouble:
    """A reason for lost points in one stage, and the submissions that share it."""

    stage: str
    slip: str | None
    reason: str
    submissions: tuple[str, ...]

    @property
    def count(self) -> int:
        """Number of submissions with this trouble."""
        return len(self.submissions)


def stage_names(results: Iterable[Result]) -> list[str]:
    """Names of all stages, in the order in which the results hold them; a bonus that nobody tried is left out."""
    names: dict[str, bool] = {}
    for result in results:
        for stage in result.stages:
            names[stage.name] = names.get(stage.name, False) or not (stage.bonus and stage.status == "missing")
    return [name for name, shown in names.items() if shown]


def stage_summaries(results: Sequence[Result]) -> list[StageSummary]:
    """Average each stage over the graded submissions; those that wait for a reader do not count."""
    summaries = []
    for name in stage_names(results):
        verdicts = [v for r in results if r.status == "graded" for v in r.stages if v.name == name]
        judged = [v for v in verdicts if v.status != "awaiting_mark"]
        if judged:
            mean = sum(v.score for v in judged) / len(judged)
            passed = sum(v.status == "passed" for v in judged)
            most = max(v.max_score for v in judged)
            summaries.append(StageSummary(name, most, mean, passed, len(judged), judged[0].bonus))
    return summaries


def mean_score(results: Iterable[Result]) -> float | None:
    """Mean total of the graded submissions, None where there is none."""
    scores = [r.score for r in results if r.status == "graded" and r.score is not None]
    return sum(scores) / len(scores) if scores else None


def provisional(results: Sequence[Result]) -> str:
    """Say how much of the maximum is judged while points wait for a reader; "" where none do.

    Examples
    --------
    >>> waiting = Result(submission="ann", status="graded", score=80.0, max_score=100.0, provisional=True, awaiting=5.0,
    ...                  confinement="full", seed=0, grader_version="0", fingerprint="", seconds=0.0)
    >>> provisional([waiting])
    'provisional, of 95'
    """
    waiting = [result for result in results if result.provisional]
    if not waiting:
        return ""
    least = min(result.max_score - result.awaiting for result in waiting)
    return f"provisional, of {points(least)}"


def waiting(results: Sequence[Result]) -> str:
    """Say the same of a class, with how many wait; "" where nobody does."""
    said = provisional(results)
    count = sum(result.provisional for result in results)
    return f"{said}: written answers of {count} of {len(results)} wait for a reader" if said else ""


def troubles(results: Iterable[Result]) -> list[Trouble]:
    """Group lost points by stage and reason, the most frequent first.

    The reason is the recognised slip; without one, those who answered alike stand together, and those
    whose messages differ in their numbers only. Recognised slips stand before the rest. Where the same
    submissions lost several stages for the same reason, these stages make one group. A stage that is wrong
    only because an earlier one is does not count again.
    """
    order: dict[str, int] = {}
    words: dict[str, str] = {}
    found: dict[tuple[str, str | None, str], list[str]] = {}
    for result in results:
        for stage in result.stages:
            order.setdefault(stage.name, len(order))
            lost = stage.status not in FULL and not (stage.bonus and stage.status == "missing")
            if lost and not is_consequence(stage) and not _is_read(stage):
                key = (stage.name, stage.slip, _kind(stage))
                words.setdefault(key[2], reason(stage))
                found.setdefault(key, []).append(result.submission)
    joined: dict[tuple[str | None, str, tuple[str, ...]], list[str]] = {}
    for (name, slip, kind), submissions in found.items():
        joined.setdefault((slip, kind, tuple(submissions)), []).append(name)
    listed = sorted(joined.items(), key=lambda item: (-len(item[0][2]), item[0][0] is None, order[item[1][0]]))
    return [
        Trouble(names[0] if len(names) == 1 else f"{names[0]} +{len(names) - 1}", slip, words[kind], submissions)
        for (slip, kind, submissions), names in listed
    ]


def _kind(stage: StageVerdict) -> str:
    """Tell mistakes apart: by the slip's name, by behaviour where numbers were wrong, else by the message."""
    if not stage.slip and stage.group and stage.status in ("failed", "partial"):
        return f"{stage.name} {stage.group}"
    return _NUMBERS.sub("#", reason(stage))


def is_consequence(stage: StageVerdict) -> bool:
    """Tell a stage that is wrong only because an earlier one is: its failed checks were paid for in part."""
    failed = [check for check in stage.checks if not check.passed]
    return bool(failed) and all(check.points > 0 for check in failed)


def _is_read(stage: StageVerdict) -> bool:
    """Tell a stage whose points come from a person: the reason is told to one student and is no mistake of a class."""
    by_hand = stage.name == "written" and stage.status != "missing"
    return by_hand or bool(stage.checks and all(check.passed for check in stage.checks))


def reason(stage: StageVerdict) -> str:
    """Say shortly why a stage lost points: the slip's name, else the first sentence of the message.

    Examples
    --------
    >>> reason(StageVerdict(name="residual", status="failed", score=0.0, max_score=15.0, slip="prior_mean_dropped"))
    'prior mean dropped'
    """
    if stage.slip:
        return stage.slip.replace("_", " ")
    if stage.status in ("missing", "timeout", "memory"):
        return MARKS[stage.status][1]
    first, _, _ = visible(stage.message).partition(". ")
    return first.rstrip(".") or MARKS[stage.status][1]


def most_instructive(results: Iterable[Result]) -> tuple[Result, StageVerdict, dict[str, Any]] | None:
    """Pick the counterexample that teaches most: a named slip that many share, drawn on a small graph."""
    results = list(results)
    shared = Counter((stage.name, stage.slip) for r in results for stage in r.stages)
    best: tuple[tuple[Any, ...], tuple[Result, StageVerdict, dict[str, Any]]] | None = None
    for result in results:
        for position, stage in enumerate(result.stages):
            for check in stage.checks:
                example = check.counterexample
                if check.passed or not example or not isinstance(example.get("got"), list):
                    continue
                graph = example.get("graph")
                poses = graph.get("n_poses", 99) if isinstance(graph, dict) else 99
                rank = (stage.slip is None, poses > 5, -shared[stage.name, stage.slip], position, poses)
                if best is None or rank < best[0]:
                    best = rank, (result, stage, example)
    return best[1] if best else None
