"""results.json: one test a check, with what the feedback policy shows, and never a hidden test.

A single hidden test would hide a student's total, so visibility is said once, for all tests alike.
"""

from __future__ import annotations

import html
from collections.abc import Sequence
from typing import Any, Literal

import msgspec

from autograder.exports.words import case_text, general, total
from autograder.reports.feedback import Policy, shown_notes
from autograder.reports.wording import outcome, visible
from autograder.verdicts import CheckVerdict, Result, StageVerdict

Visibility = Literal["visible", "after_due_date", "after_published"]
_LONGEST = 20_000  # characters of one test's output: nobody reads more, and the site must show it

OUR_FAULT = (
    "The autograder could not grade this submission. This is no fault of yours, and the 0 shown here is not your mark: "
    "the course staff can see what happened and will grade it again. What you handed in is kept."
)


def results_json(
    result: Result,
    policy: Policy = "full",
    *,
    visibility: Visibility = "visible",
    course: str = "1D SLAM",
    notes: Sequence[str] = (),
) -> bytes:
    """Write one submission's results.json.

    Parameters
    ----------
    result : Result
        What the grader found.
    policy : {"full", "hint", "score"}
        How much a failed test says.
    visibility : {"visible", "after_due_date", "after_published"}
        From when on students see all of it.
    course : str
        Title of the homework.
    notes : sequence of str
        What else the student should know.
    """
    if result.score is None:
        return failure_json(visibility=visibility)
    said = [f"{visible(course)}: {total(result)}", general(result), *map(visible, notes)]
    if policy != "score":
        said += [f"About your file: {visible(note)}" for note in shown_notes(result, policy)]
        said += [f"Remark, which costs nothing: {visible(text)}" for stage in result.stages for text in stage.remarks]
    return _encode(
        {
            "score": result.score,
            "execution_time": round(result.seconds, 2),
            "output": _paragraphs([line for line in said if line]),
            "output_format": "html",
            "visibility": visibility,
            "stdout_visibility": "hidden",
            "extra_data": {
                "status": result.status,
                "variant": result.variant,
                "grader_version": result.grader_version,
                "confinement": result.confinement,
                "fingerprint": result.fingerprint,
            },
            "tests": _tests(result, policy, visibility),
        }
    )


def failure_json(words: str = OUR_FAULT, *, visibility: Visibility = "visible") -> bytes:
    """Write the results.json of a submission that could not be graded: no points, and a sentence that says why."""
    return _encode(
        {
            "score": 0.0,
            "output": _paragraphs([words]),
            "output_format": "html",
            "visibility": visibility,
            "stdout_visibility": "hidden",
            "extra_data": {"status": "grader_error"},
            "tests": [],
        }
    )


def _tests(result: Result, policy: Policy, visibility: Visibility) -> list[dict[str, Any]]:
    tests = []
    graded = [stage for stage in result.stages if stage.status != "awaiting_mark"]
    for number, stage in enumerate(graded, 1):
        first = next((check for check in stage.checks if not check.passed), None)
        for part, check in enumerate(stage.checks or (_whole(stage),), 1):
            tests.append(
                {
                    "number": f"{number}.{part}",
                    "name": f"{_spaced(stage.name)}{' (bonus)' if stage.bonus else ''}: {_spaced(check.name)}",
                    "name_format": "text",
                    "score": check.points,
                    "max_score": check.max_points,
                    "status": "passed" if check.passed else "failed",
                    "output": "" if check.passed else _output(stage, check, policy, check is first),
                    "output_format": "html",
                    "visibility": visibility,
                }
            )
    return tests


def _whole(stage: StageVerdict) -> CheckVerdict:
    """Stand in for the checks of a stage that has none."""
    return CheckVerdict(
        name="all",
        passed=stage.status == "passed",
        points=stage.score,
        max_points=stage.max_score,
        cases=0,
        message=stage.message,
    )


def _output(stage: StageVerdict, check: CheckVerdict, policy: Policy, first: bool) -> str:
    """Say why a check failed; the stage's reason and hint stand with its first failed check."""
    if policy == "score":
        return ""
    said = stage.message if first and stage.message else check.message
    if policy == "hint" or not said:
        said = outcome(stage).capitalize() + "."
    lines = [visible(said, 2000)]
    if first and stage.hint:
        lines.append(f"Hint: {visible(stage.hint, 2000)}")
    case = case_text(check) if policy == "full" else ""
    shown = f"<pre>{html.escape(case[:_LONGEST])}</pre>" if case else ""
    return _paragraphs(lines) + shown


def _paragraphs(lines: Sequence[str]) -> str:
    return "\n".join(f"<p>{html.escape(line)}</p>" for line in lines)


def _spaced(name: str) -> str:
    return name.replace("_", " ")


def _encode(content: dict[str, Any]) -> bytes:
    return msgspec.json.format(msgspec.json.encode(content), indent=2) + b"\n"
