"""What a teacher may set, and what holds where nothing is set."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from datetime import datetime
from types import MappingProxyType
from typing import Any, Literal

from autograder.stages import catalogue

DEFAULT_POINTS: Mapping[str, float] = MappingProxyType(catalogue.points())
STAGES = tuple(DEFAULT_POINTS)
BONUS = catalogue.bonus()

# The written answers share the points of their stage in these proportions.
QUESTION_POINTS: Mapping[str, float] = MappingProxyType({"2": 2.0, "3": 3.0})
# Settings that reports apply to stored verdicts: changing them runs nobody's code again.
AFTERWARDS = frozenset(
    {
        "title", "feedback", "before_due", "due", "zone", "grace_minutes", "late_per_day", "late_days", "extensions",
        "question_points", "guide",
    }
)  # fmt: skip

Feedback = Literal["full", "hint", "score"]
Level = Literal["full", "seccomp", "none"]


@dataclass(frozen=True)
class Course:
    """The settings of a course; the defaults hold where a course file says nothing.

    Parameters
    ----------
    title : str
        Name of the homework on reports.
    points : mapping of str to float
        Points of every stage that is graded by this version, used or not.
    stages : tuple of str
        The stages that this course uses, in the order of the homework.
    follow_through : float
        Share of the points for a step that is right by itself, where an earlier function is wrong.
    bonus_cap : float
        What a score may reach with bonus points.
    examples : int
        Drawn cases a stage.
    seed : int or None
        Seed of the draw; None leaves it to the command line.
    time_limit : float
        CPU time a check may take [s].
    memory_mib : int
        Memory a submission may take [MiB].
    output_mib : int
        What a submission may print [MiB].
    feedback : {"full", "hint", "score"}
        What a student is shown of a failed check.
    before_due : {"full", "hint", "score"} or None
        What a student is shown until the last due date has passed; None: no difference.
    due : datetime or None
        When the homework is due; None: nothing is late.
    zone : str
        Name of the time zone of the course, such as "Europe/Berlin"; "" where none is named.
    grace_minutes : float
        Minutes after the due date that cost nothing.
    late_per_day : float
        Per cent of the maximum that each begun day costs.
    late_days : int or None
        After so many days a submission scores 0; None: never.
    extensions : mapping of str to datetime
        Other due dates, by name of the submission or by student id.
    question_points : mapping of str to float
        Points of the written answers, by question; they share those of the stage `written`.
    guide : str
        Marking guide of the written answers, as markdown; "" for that of the worked solution.
    min_confinement : {"full", "seccomp", "none"}
        The least confinement under which this course is graded.
    families : tuple of str
        Families that variants are drawn from; one that stands twice is drawn twice as often.
    """

    title: str = "1D SLAM"
    points: Mapping[str, float] = field(default_factory=lambda: dict(DEFAULT_POINTS))
    stages: tuple[str, ...] = STAGES
    follow_through: float = 1.0
    bonus_cap: float = 110.0
    examples: int = 200
    seed: int | None = None
    time_limit: float = 2.0
    memory_mib: int = 512
    output_mib: int = 16
    feedback: Feedback = "full"
    before_due: Feedback | None = None
    due: datetime | None = None
    zone: str = ""
    grace_minutes: float = 0.0
    late_per_day: float = 0.0
    late_days: int | None = None
    extensions: Mapping[str, datetime] = field(default_factory=dict)
    question_points: Mapping[str, float] = field(default_factory=lambda: dict(QUESTION_POINTS))
    guide: str = ""
    min_confinement: Level = "seccomp"
    families: tuple[str, ...] = ("A",)

    @property
    def max_score(self) -> float:
        """The points of all stages in use, without bonus."""
        return float(sum(self.points[stage] for stage in self.stages if stage not in BONUS))

    def judging(self) -> dict[str, Any]:
        """Return the settings that a verdict may depend on, as plain data."""
        return {name: value for name, value in asdict(self).items() if name not in AFTERWARDS}
