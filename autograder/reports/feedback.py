"""The page of one student: what was lost, the smallest case that shows it, what passed.

What a page shows is copied from an allow-list: `score` shows points only, `hint` the hints too, and
`full` the reasons and counterexamples.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from markupsafe import Markup

from autograder.render import figure
from autograder.reports.comparison import Part, parts
from autograder.reports.counterexample import part_text
from autograder.reports.html import page, picture
from autograder.reports.picture import LARGEST
from autograder.reports.picture import picture as text_picture
from autograder.reports.reproduce import call_text
from autograder.reports.wording import number
from autograder.verdicts import CheckVerdict, Result, StageVerdict

Policy = Literal["full", "hint", "score"]
# What a statement raised is its author's text, and the inputs of the exam lie in memory while it runs.
_RAISED = re.compile(r"((?:cell \d+, )?line \d+): ")
_LARGEST_MATRIX = 6
_LONGEST_VECTOR = 12


@dataclass(frozen=True)
class Drawn:
    """One counterexample, ready for the page."""

    graph: Markup | None
    call: str
    tables: tuple[Table, ...]
    spies: tuple[Markup, ...]


@dataclass(frozen=True)
class Table:
    """Got beside expected; `said` instead where they cannot be compared entry by entry."""

    letter: str
    said: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, tuple[tuple[str, bool], ...], tuple[str, ...]], ...]


@dataclass(frozen=True)
class Lost:
    """A stage that lost points, with its first failed check."""

    stage: StageVerdict
    checks: tuple[CheckVerdict, ...]
    drawn: Drawn | None


def feedback_page(result: Result, policy: Policy = "full", course: str = "1D SLAM", later: str = "") -> str:
    """Write the page of one student.

    Parameters
    ----------
    result : Result
        The student's result.
    policy : {"full", "hint", "score"}
        How much is shown.
    course : str
        Title of the homework.
    later : str
        A sentence that says what follows, and when; "" where this is all.
    """
    lost = []
    for stage in result.stages:
        if stage.status in ("passed", "awaiting_mark"):
            continue
        failed = tuple(check for check in stage.checks if not check.passed)
        shown = next((check.counterexample for check in failed if check.counterexample), None)
        lost.append(Lost(stage, failed, drawn(shown) if shown and policy == "full" else None))
    passed = [(stage.name, check) for stage in result.stages for check in stage.checks if check.passed]
    notes = shown_notes(result, policy)
    told = {"policy": policy, "course": course, "later": later, "notes": notes}
    return page("feedback.html.j2", result=result, lost=lost, passed=passed, **told)


def shown_notes(result: Result, policy: Policy) -> tuple[str, ...]:
    """Return the remarks about the file that a policy shows: `hint` says where a statement was skipped, not why."""
    return result.notes if policy == "full" else tuple(map(_place_only, result.notes))


def _place_only(note: str) -> str:
    """Keep of a remark about a statement where it stands, and of any other remark all."""
    raised = _RAISED.match(note)
    return f"{raised[1]} was skipped." if raised else note


def drawn(counterexample: Mapping[str, Any]) -> Drawn:
    """Lay out one counterexample: figure, call, tables, patterns."""
    found = parts(counterexample)
    return Drawn(
        graph=graph_picture(counterexample.get("graph")),
        call=call_text(counterexample),
        tables=tuple(_table(part) for part in found),
        spies=tuple(_spies(found)),
    )


def graph_picture(graph: Any) -> Markup | None:
    """Draw a graph, with its factors in words; None where there is none."""
    if not isinstance(graph, Mapping):
        return None
    if graph["n_poses"] > LARGEST or len(graph["edges"]) > 2 * LARGEST:
        return Markup("<pre>{}</pre>").format(text_picture(graph))
    edges = [(i, j, float(u)) for (i, j), u in zip(graph["edges"], graph["measurements"], strict=True)]
    priors = list(zip(graph["priors"], graph["prior_means"], strict=True))
    words = [f"{i} to {j} measured {number(u)} m" for i, j, u in edges]
    words += [f"prior on {k} with mean {number(mean)} m" for k, mean in priors]
    described = f"Pose graph with {graph['n_poses']} poses. {'; '.join(words)}."
    return picture(figure.pose_graph(graph["n_poses"], edges, priors), described)


def _table(part: Part) -> Table:
    tall = len(part.expected)
    wide = max((len(row) for row in part.expected), default=0)
    vector = len(part.expected_shape) == 1
    if not part.wrong or tall > (_LONGEST_VECTOR if vector else _LARGEST_MATRIX) or wide > _LARGEST_MATRIX:
        return Table(part.letter, part_text(part), (), ())
    left, right = part.entries()
    rows = tuple(
        (name, tuple((entry, (r, c) in part.wrong) for c, entry in enumerate(left[r])), tuple(right[r]))
        for r, name in enumerate(part.rows)
    )
    return Table(part.letter, "", part.columns, rows)


def _spies(found: list[Part]) -> list[Markup]:
    """Draw the patterns of J and H where they differ: as it came, and as it should be."""
    pictures = []
    for part in found:
        if (
            part.letter not in ("J", "H")
            or isinstance(part.got, str)
            or len(part.got_shape) != len(part.expected_shape)
        ):
            continue
        yours, right = _pattern(part.got), _pattern(part.expected)
        if yours != right and yours and yours[0]:
            for entries, name in ((yours, f"your {part.letter}"), (right, f"right {part.letter}")):
                filled = sum(map(sum, entries))
                told = f"Pattern of {name}: {filled} of {len(entries) * len(entries[0])} entries are not 0."
                pictures.append(picture(figure.spy(entries, name), told))
    return pictures


def _pattern(table: Any) -> list[list[int]]:
    wide = max((len(row) for row in table), default=0)
    return [[int(entry != 0) for entry in row] + [0] * (wide - len(row)) for row in table]
