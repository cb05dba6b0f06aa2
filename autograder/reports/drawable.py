"""A page for every result: where a case cannot be drawn it is left out, the marks stand, and staff hear of it."""

from __future__ import annotations

from msgspec.structs import replace

from autograder.attempts import Attempts
from autograder.reports.feedback import Policy, feedback_page
from autograder.verdicts import Result


def drawable(result: Result, policy: Policy = "full", course: str = "1D SLAM", later: str = "") -> tuple[Result, str]:
    """Return a result with its page; without its cases, and with a flag, where these cannot be drawn."""
    attempt = Attempts()
    page = attempt("drawing its page", feedback_page, result, policy, course, later)
    if page is not None:
        return result, page
    bare = replace(without_cases(result), flags=(*result.flags, *attempt.flags))
    return bare, feedback_page(bare, policy, course, later)


def without_cases(result: Result) -> Result:
    """Take every counterexample out of a result: what is left are marks and sentences."""
    stages = [
        replace(stage, checks=tuple(replace(check, counterexample=None) for check in stage.checks))
        for stage in result.stages
    ]
    return replace(result, stages=tuple(stages))
