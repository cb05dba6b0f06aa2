"""The written answers of a notebook: the markdown under questions 2 and 3, without the printed prompt."""

from __future__ import annotations

import re
from collections.abc import Sequence

_QUESTION = re.compile(r"^\s*#+\s*Question\s+(\d)\b", re.IGNORECASE)
_PROMPT = re.compile(r"^\s*\*\*Your answer to question (\d)\*\*(?:[^\n]*?edit this cell\):)?[ \t]*", re.IGNORECASE)
# what was handed out below a question, and is nobody's answer to it
_END = re.compile(r"^\s*(#+\s|Save, and hand in\b|\*\*Along a line\.\*\*)", re.IGNORECASE)


def written_answers(markdown: Sequence[str]) -> dict[str, str]:
    r"""Find what a student wrote under each question, whatever happened to the cells.

    A cell that begins with the prompt belongs to the question that it names; any other cell to
    the question whose heading stands last above it.

    Parameters
    ----------
    markdown : sequence of str
        The markdown cells in order.

    Returns
    -------
    dict
        Number of the question, as text, to the answer; questions without words are left out.

    Examples
    --------
    >>> cells = ["## Question 2\n\nTake further steps.", "**Your answer to question 2** (two; edit this cell): zero."]
    >>> written_answers(cells)
    {'2': 'zero.'}
    """
    found: dict[str, list[str]] = {}
    current = ""
    for cell in markdown:
        heading, prompt = _QUESTION.match(cell), _PROMPT.match(cell)
        if heading:
            current = heading[1]
        elif prompt:
            current = prompt[1]
            found.setdefault(current, []).append(cell[prompt.end() :])
        elif _END.match(cell):
            current = ""
        elif current:
            found.setdefault(current, []).append(cell)
    texts = {number: "\n\n".join(part.strip() for part in parts if part.strip()) for number, parts in found.items()}
    return {number: text for number, text in sorted(texts.items()) if text}
