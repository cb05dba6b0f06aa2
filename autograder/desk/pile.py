"""The pile of answers on the desk: in order, with the marks that were given; every new one goes to disk at once."""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from autograder.errors import UsageError
from autograder.marking.answers import Answer
from autograder.marking.marks import LONGEST_COMMENT, Mark, digest, read_marks, write_marks
from autograder.marking.tables import number

_MOST_USED = 9  # comments to choose from, a digit each


class Pile:
    """All answers of a run.

    Parameters
    ----------
    out : Path
        The folder of the run.
    answers : sequence of Answer
        In the order of reading; those to one question that say the same are put together.
    """

    def __init__(self, out: Path, answers: Sequence[Answer]) -> None:
        self.out = out
        first = {_said(answer): place for place, answer in reversed(list(enumerate(answers)))}
        self._answers = sorted(answers, key=lambda one: (one.question, first[_said(one)]))
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

    def alike(self, index: int) -> list[int]:
        """Return all answers to the same question with the same words and pictures, this one among them."""
        said = _said(self._answers[index])
        return [k for k, one in enumerate(self._answers) if _said(one) == said]

    def used(self, question: str, most: int = _MOST_USED) -> list[str]:
        """Return the comments that were given for a question, the most frequent first."""
        given = [one.mark.comment for one in self._answers if one.question == question and one.mark is not None]
        return [comment for comment, _ in Counter(filter(None, given)).most_common(most)]

    def give(self, index: int, points: str, comment: str, *, together: bool = False) -> None:
        """Mark an answer, or with empty points take its mark back; stored when this returns.

        With `together` all answers that say the same are marked alike.

        Raises
        ------
        UsageError
            Where the points are none, or beyond the question's.
        """
        most = self._answers[index].most
        comment = comment.replace("\r\n", "\n").strip()[:LONGEST_COMMENT]
        value = None
        if points.strip():
            value = number(points)
            if value is None or not 0 <= value <= most:
                raise UsageError(f"{points.strip()[:20]} is no number from 0 to {most:g}; nothing was stored.")
        elif comment:
            raise UsageError("A comment needs points, 0 if need be; nothing was stored.")
        with self._lock:
            marks = read_marks(self.out)  # again each time: another reader may have written meanwhile
            for place in self.alike(index) if together else [index]:
                answer = self._answers[place]
                marks.pop((answer.submission, answer.question), None)
                mark = None
                if value is not None:
                    mark = Mark(answer.submission, answer.question, value, most, comment, digest(answer.text))
                    marks[mark.key] = mark
                self._answers[place] = replace(answer, mark=mark, stale=False)
            write_marks(self.out, marks.values())


def _said(answer: Answer) -> tuple[str, str, tuple[str, ...]]:
    """Return what makes two answers the same: the question, the words, the pictures that they show."""
    shown = sorted(data for name, data in answer.images.items() if name in answer.text)
    return answer.question, digest(answer.text), tuple(shown)
