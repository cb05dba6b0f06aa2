"""Files whose name says nothing of use: what is inside decides whether they are read, and what is said of them."""

from __future__ import annotations

import re

from autograder.errors import RejectedUpload
from autograder.intake.module import MAX_SOURCE, read_module, reject_foreign
from autograder.intake.naming import printable
from autograder.intake.notebook import MAX_NOTEBOOK, looks_like_notebook
from autograder.intake.tree import EXPECTED, HANDED_OUT, Entry, is_candidate

_FUNCTION = re.compile(
    r"^(?:async )?def (?:residual|jacobian|information_matrix|normal_equations|gauss_newton_step)\b", re.MULTILINE
)
_FENCE = re.compile(r"^(?:```|~~~)", re.MULTILINE)  # code between such lines is a part of another document


def is_read(entry: Entry) -> bool:
    """Say whether a file is a submission by its name or, where that says nothing, by what is inside."""
    if is_candidate(entry):
        return True
    return entry.name.casefold() not in HANDED_OUT and not problem_inside(entry)


def problem_inside(entry: Entry) -> str:
    """Say why a file is neither notebook nor module, as the end of a sentence; "" where it is one."""
    if entry.problem:
        return entry.problem
    try:
        data = entry.load(MAX_NOTEBOOK)
        if looks_like_notebook(data):
            return ""
        reject_foreign(data)
        if not data.strip():
            return f"is empty, {EXPECTED}"
        if data.lstrip()[:1] == b"<":
            return "is a web page, no submission; download the .py or .ipynb file itself and hand that in"
        text = read_module(data) if len(data) <= MAX_SOURCE else ""
    except RejectedUpload as error:
        return str(error)
    if _FUNCTION.search(text) and not _FENCE.search(text):
        return ""
    return wrong_kind_problem(entry)


def wrong_kind_problem(entry: Entry) -> str:
    """Say what came and what was expected, as the end of a sentence."""
    kind = printable(entry.suffix)[:20]
    return f"is a {kind or 'file without a suffix'}, {EXPECTED}; save or pack it as one of these"
