"""What a run is told and what it ends with: settings, assignments, progress, results."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from autograder.engine.corpus import plain_case
from autograder.engine.store import RunRecord
from autograder.problems.copied import Numbers
from autograder.problems.variants import Variant
from autograder.verdicts import Result


@dataclass(frozen=True)
class Settings:
    """What the command line sets for one run; see `autograder grade --help`."""

    seed: int = 0
    examples: int = 200
    workers: int | None = None
    time_limit: float = 2.0
    fresh: bool = False
    feedback: Literal["full", "hint", "score"] = "full"
    min_confinement: Literal["full", "seccomp", "none"] = "seccomp"
    allow_unconfined: bool = False
    scheduler: str | None = None


@dataclass(frozen=True)
class Progress:
    """One submission has its result: `done` of `total`; `reused` of them were graded before."""

    done: int
    total: int
    reused: int
    submission: str


@dataclass(frozen=True)
class Assigned:
    """What a submission is judged on beside its functions: whose it is, and which variant.

    Parameters
    ----------
    student_id : str or None
        The student, where known.
    variant : Variant
        The variant on record.
    others : Numbers or None
        The numbers of the whole class, to recognise somebody else's.
    note : str
        How the submission was matched; the student may read it. "" where all is plain.
    flag : str
        What only staff should know, such as a second submission or somebody else's name.
    by : str
        What told whose it is, the roster asked; "" where nothing did.
    account : str or None
        The person in the system of the uploads, as "Canvas 101"; None where the upload itself says it.
    free : bool
        Whether the id of the upload's system may stand where nobody is known: in the roster it is nobody's.
    """

    variant: Variant
    student_id: str | None = None
    others: Numbers | None = None
    note: str = ""
    flag: str = ""
    by: str = ""
    account: str | None = None
    free: bool = True

    @property
    def sheet(self) -> tuple[str, list[Any]]:
        """What a worker is told of the variant."""
        return self.variant.identifier, plain_case((self.variant.graph, self.variant.iterates))


@dataclass(frozen=True)
class Run:
    """What a run ends with: a result for every submission that was reached, and its record."""

    results: tuple[Result, ...]
    record: RunRecord
    interrupted: bool
