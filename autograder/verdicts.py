"""What grading says: one value for a check, a stage and a submission, as they stand in results/*.json."""

from __future__ import annotations

from typing import Any, Literal

import msgspec

StageStatus = Literal[
    "passed",
    "partial",
    "failed",
    "error",
    "timeout",
    "memory",
    "missing",
    "forbidden",
    "awaiting_mark",
]
SubmissionStatus = Literal["graded", "rejected", "grader_error"]


class CheckVerdict(msgspec.Struct, frozen=True, kw_only=True):
    """One check of a stage: all or nothing.

    `counterexample` is the smallest case that shows the mistake, as plain JSON data, or None.
    """

    name: str
    passed: bool
    points: float
    max_points: float
    cases: int
    message: str = ""
    counterexample: dict[str, Any] | None = None


class StageVerdict(msgspec.Struct, frozen=True, kw_only=True):
    """One stage of a submission: the sum of its checks, and the reason in words.

    `group` is the same for submissions that answered alike where they are wrong.
    """

    name: str
    status: StageStatus
    score: float
    max_score: float
    bonus: bool = False
    slip: str | None = None
    message: str = ""
    hint: str = ""
    remarks: tuple[str, ...] = ()
    group: str = ""
    checks: tuple[CheckVerdict, ...] = ()


class Adjustment(msgspec.Struct, frozen=True, kw_only=True):
    """One change of points after the machine's verdict: by a person, or by a rule of the course.

    `stage` is "" where the total is meant; `said` is the whole reason in words, for the student too.
    """

    stage: str
    before: float | None
    after: float
    said: str


class Reported(msgspec.Struct, frozen=True, kw_only=True):
    """What a student reported for the variant on record, beside what is right: for staff.

    `graph` is the variant as plain data. `iterates` is empty where there is no table of numbers, and `said` why;
    a number that is not finite is None. `choice` is what `conclusion`, the letter, stands for in this variant, and
    `letters` those of all choices in it.
    """

    graph: dict[str, Any] = {}
    right: list[list[float]] = []
    iterates: list[list[float | None]] = []
    said: str = ""
    conclusion: str = ""
    choice: str = ""
    right_letter: str = ""
    letters: dict[str, str] = {}


class Result(msgspec.Struct, frozen=True, kw_only=True):
    """One submission, as written to results/<submission>.json.

    `by` is what told whose it is, when the roster was asked; `account` is the person in the system of the
    uploads, such as "Canvas 101", and `student_id` where no roster was asked is what that system says.
    `score` is None exactly when `status` is "grader_error": our fault is never a zero. `awaiting`
    are points that a human reader has still to give; as long as there are any, the score is
    `provisional`. `locks` says in words what the level of `confinement` stands for;
    an upload of which nothing was run has none. `exam` is the digest of the exam file. `flags` are for
    staff only, such as numbers that belong to somebody else. `in_vain` says of functions that somebody tried to write
    why they are not there; it stands first on the student's page. `written` are the answers in words by
    question, and `images` the pictures in them, by name, as data URIs; `reported` are the other answers.
    `submitted` and `late` are what the system of the course says of the time. What people decide later, the
    `comments` on written answers by question and the `adjustments`, is merged into reports and never stored here.
    """

    submission: str
    student_id: str | None = None
    by: str = ""
    account: str = ""
    variant: str = "worked-example"
    status: SubmissionStatus
    message: str = ""
    score: float | None
    max_score: float
    bonus: float = 0.0
    provisional: bool = False
    awaiting: float = 0.0
    stages: tuple[StageVerdict, ...] = ()
    notes: tuple[str, ...] = ()
    flags: tuple[str, ...] = ()
    in_vain: tuple[str, ...] = ()
    written: dict[str, str] = {}
    images: dict[str, str] = {}
    reported: Reported | None = None
    comments: dict[str, str] = {}
    adjustments: tuple[Adjustment, ...] = ()
    submitted: str = ""
    late: bool | None = None
    confinement: str
    locks: str = ""
    exam: str = ""
    seed: int
    grader_version: str
    fingerprint: str
    seconds: float


def encode(result: Result) -> bytes:
    """Write a result as indented JSON with a final newline.

    Examples
    --------
    >>> result = Result(
    ...     submission="alice", status="rejected", message="alice.txt is no Python.", score=0.0,
    ...     max_score=90.0, confinement="full", seed=0, grader_version="0", fingerprint="", seconds=0.0,
    ... )
    >>> decode(encode(result)) == result
    True
    """
    return msgspec.json.format(msgspec.json.encode(result), indent=2) + b"\n"


def decode(data: bytes) -> Result:
    """Read a result; raises msgspec.ValidationError where the bytes are no result."""
    return msgspec.json.decode(data, type=Result)
