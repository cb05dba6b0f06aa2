"""A student's feedback as plain text: what the page says, for places that show no page.

What is shown follows the same policy as the page: `score` points only, `hint` the hints too, `full` the reasons and
the smallest case as well.
"""

from __future__ import annotations

import textwrap

from autograder.reports.counterexample import counterexample_text
from autograder.reports.feedback import Policy, shown_notes
from autograder.reports.wording import outcome, points, visible
from autograder.verdicts import CheckVerdict, Result, StageVerdict

WIDTH = 100
_SILENT = ("passed", "awaiting_mark")


def feedback_text(result: Result, policy: Policy = "full", course: str = "1D SLAM", later: str = "") -> str:
    """Write a student's feedback as text that ends with a newline; `later` says what follows, and when.

    Examples
    --------
    >>> stage = StageVerdict(name="jacobian", status="failed", score=0.0, max_score=15.0, message="J is off.",
    ...                      hint="Which pose does the factor predict?")
    >>> result = Result(submission="ann", status="graded", score=75.0, max_score=90.0, stages=(stage,),
    ...                 confinement="full", seed=0, grader_version="0", fingerprint="", seconds=0.0)
    >>> print(feedback_text(result, "hint"), end="")
    1D SLAM: 75 of 90 points
    <BLANKLINE>
    jacobian: 0 of 15, wrong values
      Hint: Which pose does the factor predict?
    """
    lines = [f"{visible(course)}: {total(result)}"]
    lines += _wrapped(general(result), "") + _wrapped(visible(later), "")
    for each in result.adjustments:
        lines += _wrapped(visible(each.said), "")
    for stage in result.stages:
        lines += ["", _heading(stage, policy)]
        if stage.status not in _SILENT and policy != "score":
            lines += stage_lines(stage, policy)
    if policy != "score":
        said_of = [f"Question {question}: {comment}" for question, comment in sorted(result.comments.items())]
        remarks = [remark for stage in result.stages for remark in stage.remarks]
        notes = shown_notes(result, policy)
        for title, said in (("About your file (what is named did not run and was skipped):", notes),
                            ("Comments on your written answers:", said_of),
                            ("Remarks, which cost nothing:", remarks)):  # fmt: skip
            if said:
                lines += ["", title, *(line for one in said for line in _wrapped(f"- {visible(one)}", "  "))]
    return "\n".join(lines) + "\n"


def total(result: Result) -> str:
    """Say the score in words."""
    if result.score is None:
        return "not graded yet"
    return f"{points(result.score)} of {points(result.max_score)} points"


def general(result: Result) -> str:
    """Say what holds for the whole submission; "" where nothing does."""
    if result.status == "rejected":
        return f"This upload could not be read: {visible(result.message)} A person will look at it."
    if result.status == "grader_error":
        return "Something went wrong on our side; this is no fault of yours, and no zero. A person will look at it."
    if result.provisional:
        graded = points(result.max_score - result.awaiting)
        return f"Provisional, of {graded}: {points(result.awaiting)} points wait for a reader."
    return ""


def stage_lines(stage: StageVerdict, policy: Policy) -> list[str]:
    """Say why a stage lost points, as far as the policy allows."""
    lines = []
    if policy == "full" and stage.message:
        lines += _wrapped(visible(stage.message), "  ")
    if policy != "score" and stage.hint:
        lines += _wrapped(f"Hint: {visible(stage.hint)}", "  ")
    shown = next((check for check in stage.checks if check.counterexample), None)
    if policy == "full" and shown is not None:
        lines += ["", *case_text(shown).splitlines()]
    return lines


def case_text(check: CheckVerdict) -> str:
    """Show the smallest case of a failed check; "" where it has none."""
    return counterexample_text(check.counterexample, indent="    ") if check.counterexample else ""


def _heading(stage: StageVerdict, policy: Policy) -> str:
    line = f"{stage.name}: {points(stage.score)} of {points(stage.max_score)}"
    said = outcome(stage)
    return f"{line}, {said}" if policy != "score" and stage.status != "passed" else line


def _wrapped(text: str, indent: str) -> list[str]:
    return textwrap.wrap(text, WIDTH, initial_indent=indent, subsequent_indent=indent) if text else []
