"""The pile of answers on the desk: in order, with the marks that were given; every new one goes to disk at once."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from autograder.errors import UsageError
from autograder.marking.answers import Answer
from autograder.marking.marks import LONGEST_COMMENT, Mark, digest, read_marks, write_marks
from autograder.marking.tables import number


class Pile:
    """All answers of a run.

    Parameters
    ----------
    out : Path
        The folder of the run.
    answers : sequence of Answer
        In the order of reading.
    """

    def __init__(self, out: Path, answers: Sequence[Answer]) -> None:
        self.out = out
        self._answers = list(answers)
        self._lock = threading.Lock()

    def __len__(self) -> int:
        return len(self._answers)

    def __getitem__(self, index: int) -> Answer:
        """Return an answer with the mark that it has by now."""
        return self._answers[index]

    @property
    def waiting(self) -> int:
        """How many have no mark."""
        return sum(one.mark is None for one in self._answers)

    def next_waiting(self, index: int) -> int:
        """Return the next answer without a mark after `index`, round the corner; `index` itself where there is none."""
        order = [*range(index + 1, len(self)), *range(index)]
        return next((k for k in order if self[k].mark is None), index)

    def give(self, index: int, points: str, comment: str) -> Answer:
        """Mark an answer, or with empty points take its mark back; stored when this returns.

        Raises
        ------
        UsageError
            Where the points are none, or beyond the question's.
        """
        answer = self._answers[index]
        comment = comment.replace("\r\n", "\n").strip()[:LONGEST_COMMENT]
        mark = None
        if points.strip():
            value = number(points)
            if value is None or not 0 <= value <= answer.most:
                raise UsageError(f"{points.strip()[:20]} is no number from 0 to {answer.most:g}; nothing was stored.")
            mark = Mark(answer.submission, answer.question, value, answer.most, comment, digest(answer.text))
        elif comment:
            raise UsageError("A comment needs points, 0 if need be; nothing was stored.")
        with self._lock:
            marks = read_marks(self.out)  # again each time: another reader may have written meanwhile
            marks.pop((answer.submission, answer.question), None)
            if mark is not None:
                marks[mark.key] = mark
            write_marks(self.out, marks.values())
            self._answers[index] = replace(answer, mark=mark, stale=False)
        return self._answers[index]
