"""What a course says of the homework in its handout: the title, the points of what it uses, and when it is due."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from autograder.stages import answers, catalogue, written

__all__ = ["Grading"]

TITLE = "1D SLAM by weighted least squares"
_MARKS = re.compile(r"([\\`*_$\[\]<>|])")  # what Markdown, a formula or a table would take for its own


@dataclass(frozen=True)
class Grading:
    """The settings of a course that a student is told before handing in.

    Parameters
    ----------
    title : str
        Heading of the handout and of the notebook.
    points : mapping of str to float
        Points of every stage in use, in the order of the homework.
    questions : mapping of str to float
        Points of the written answers, by question.
    follow_through : float
        Share of its points that a step keeps which is right by itself, where an earlier function is wrong.
    due : str
        When the homework is due, in words; "": the handout does not say.
    """

    title: str = TITLE
    points: Mapping[str, float] = field(default_factory=catalogue.points)
    questions: Mapping[str, float] = field(default_factory=lambda: {"2": 2.0, "3": 3.0})
    follow_through: float = 1.0
    due: str = ""

    def words(self) -> dict[str, Any]:
        """Return what the templates name: points as texts, without what the course does not use."""
        functions = {one.name: self.points[one.name] for one in catalogue.all_stages() if one.name in self.points}
        own = self.points.get(answers.NAME, 0.0)
        told = {name: own * share for name, share in answers.SHARES.items()}
        if written.NAME in self.points:
            told |= {f"written_{number}": points for number, points in self.questions.items()}
        extra = {name: points for name, points in functions.items() if name in catalogue.bonus()}
        whole = sum(points for name, points in self.points.items() if name not in catalogue.bonus())
        return {
            "title": _MARKS.sub(r"\\\1", " ".join(self.title.split())),
            "points": {name: _points(value) for name, value in functions.items() if name not in extra and value},
            "answer_points": {name: _points(value) for name, value in told.items() if value},
            "bonus_points": {name: _points(value) for name, value in extra.items() if value},
            "all_points": _points(whole),
            "followed": "all" if self.follow_through == 1 else f"{_points(100 * self.follow_through)} %",
            "follows": self.follow_through > 0,
            "due": self.due,
        }


def _points(value: float) -> str:
    return f"{round(value, 2):g}"
