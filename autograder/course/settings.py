"""What a teacher may set, and what holds where nothing is set."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Literal

from autograder.stages import catalogue

DEFAULT_POINTS: Mapping[str, float] = MappingProxyType(catalogue.points())
STAGES = tuple(DEFAULT_POINTS)
BONUS = catalogue.bonus()

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
        Share of a stage's points for a step that is wrong only because an earlier function is.
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
    min_confinement : {"full", "seccomp", "none"}
        The least confinement under which this course is graded.
    families : tuple of str
        Families that variants are drawn from; one that stands twice is drawn twice as often.
    """

    title: str = "1D SLAM"
    points: Mapping[str, float] = field(default_factory=lambda: dict(DEFAULT_POINTS))
    stages: tuple[str, ...] = STAGES
    follow_through: float = 0.5
    bonus_cap: float = 110.0
    examples: int = 200
    seed: int | None = None
    time_limit: float = 2.0
    memory_mib: int = 512
    output_mib: int = 16
    feedback: Feedback = "full"
    min_confinement: Level = "seccomp"
    families: tuple[str, ...] = ("A",)

    @property
    def max_score(self) -> float:
        """The points of all stages in use, without bonus."""
        return float(sum(self.points[stage] for stage in self.stages if stage not in BONUS))
