"""Stage `written`: the answers in words, marked by a human reader; the machine only says whether there are any."""

from __future__ import annotations

from collections.abc import Mapping

NAME = "written"
TITLE = "Written answers"
POINTS = 5.0
QUESTIONS = {"2": 2.0, "3": 3.0}  # question to its points


def unanswered(texts: Mapping[str, str]) -> list[str]:
    """Return the questions without a word.

    Examples
    --------
    >>> unanswered({"2": "The second step is zero.", "3": " "})
    ['3']
    """
    return [question for question in QUESTIONS if not texts.get(question, "").strip()]
