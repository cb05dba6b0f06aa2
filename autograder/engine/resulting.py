"""What came of a submission, as it is written down: its result, and the fingerprint of the work behind it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import msgspec

import autograder
from autograder.course import Course
from autograder.engine.exam import Exam
from autograder.engine.messages import Answer, Graded, Trouble
from autograder.engine.run import Assigned
from autograder.engine.store import code_digest, fingerprint, versions
from autograder.intake.submission import Submission
from autograder.verdicts import Result


@dataclass(frozen=True)
class Ran:
    """Under what something was run: the exam, and the confinement with its wording, "" where nothing was run."""

    exam: Exam
    level: str = ""
    locks: str = ""


@dataclass(frozen=True)
class Results:
    """Writes down results of one run.

    Parameters
    ----------
    course : Course
        Points and rules.
    time_limit : float
        CPU time of a check [s].
    assigned : mapping of str to Assigned
        For each submission its student and variant.
    """

    course: Course
    time_limit: float
    assigned: Mapping[str, Assigned]

    def of(self, submission: Submission, answer: Answer, ran: Ran) -> Result:
        """Write down what a worker answered; the fault of ours has no score."""
        if isinstance(answer, Trouble):
            return self._base(submission, ran, status="grader_error", message=answer.message, score=None, seconds=0.0)
        bonus = sum(stage.score for stage in answer.stages if stage.bonus)
        score = sum(stage.score for stage in answer.stages if not stage.bonus) + bonus
        awaiting = sum(stage.max_score for stage in answer.stages if stage.status == "awaiting_mark")
        return self._base(
            submission,
            ran,
            status="graded",
            score=round(min(score, max(self.course.bonus_cap, self.course.max_score)), 6),
            seconds=answer.seconds,
            confinement=answer.confinement or ran.level,
            bonus=bonus,
            provisional=awaiting > 0,
            awaiting=awaiting,
            stages=tuple(sorted(answer.stages, key=lambda stage: self.course.stages.index(stage.name))),
            notes=(*filter(None, [self.assigned[submission.id].note]), *submission.notes, *answer.notes),
            flags=self._flags(submission, answer),
            in_vain=answer.in_vain,
            written=answer.written,
            reported=answer.reported,
            images={
                name: data
                for name, data in submission.pictures.items()
                if any(name in text for text in answer.written.values())
            },
        )

    def rejected(self, submission: Submission, exam: Exam) -> Result:
        """Write down why an upload could not be read; nothing was run."""
        return self._base(
            submission,
            Ran(exam),
            status="rejected",
            message=submission.rejection,
            score=0.0,
            flags=tuple(filter(None, [self.assigned[submission.id].flag])),
            seconds=0.0,
        )

    def fingerprint(self, submission: Submission, exam: Exam) -> str:
        """Identify the work: the exam, the rules, the grader and the upload."""
        points = {name: self.course.points[name] for name in self.course.stages}
        rules = {"points": points, "course": self.course.judging(), "time_limit": self.time_limit}
        return fingerprint(
            [
                code_digest(),
                *(f"{name}={value}" for name, value in versions().items()),
                exam.digest,
                msgspec.json.encode(rules, order="deterministic").decode(),
                submission.id,
                submission.digest,
                submission.rejection,
                self.assigned[submission.id].variant.identifier,
                self.assigned[submission.id].student_id or "",
                self.assigned[submission.id].note,
                self.assigned[submission.id].flag,
                self.assigned[submission.id].by,
                self._account(submission),
                f"{submission.submitted} {submission.late}",
                *submission.markdown,
            ]
        )

    def _flags(self, submission: Submission, answer: Graded) -> tuple[str, ...]:
        """Say, to staff only, what is odd about whose it is, and where it carries the numbers of somebody else."""
        assigned = self.assigned[submission.id]
        odd = (
            *((assigned.flag,) if assigned.flag else ()),
            *submission.flags,
            *_of_several(answer.in_vain),
            *answer.flags,
        )
        if assigned.others is None or submission.source is None:
            return odd
        carried = assigned.others.in_text(assigned.student_id, "\n".join(submission.source.cells))
        if answer.iterates is not None:
            carried = [*assigned.others.in_answers(assigned.student_id, answer.iterates), *carried]
        return (*odd, *(each.text() for each in carried))

    def _student(self, submission: Submission) -> str | None:
        """Give the student of the roster, else what the system of the uploads says, where that is nobody else's id."""
        assigned = self.assigned[submission.id]
        return assigned.student_id or (submission.student_id if assigned.free else None)

    def _account(self, submission: Submission) -> str:
        """Name the person in the system of the uploads, unless staff say that it is somebody else's work."""
        account = self.assigned[submission.id].account
        return account if account is not None else "" if submission.owner is None else submission.owner.account

    def _base(self, submission: Submission, ran: Ran, **fields: object) -> Result:
        return msgspec.convert(
            {
                "submission": submission.id,
                "student_id": self._student(submission),
                "by": self.assigned[submission.id].by,
                "account": self._account(submission),
                "variant": self.assigned[submission.id].variant.identifier,
                "max_score": self.course.max_score,
                "submitted": submission.submitted,
                "late": submission.late,
                "confinement": ran.level,
                "locks": ran.locks,
                "exam": ran.exam.digest,
                "seed": ran.exam.seed,
                "grader_version": autograder.__version__,
                "fingerprint": self.fingerprint(submission, ran.exam),
                **fields,
            },
            Result,
            from_attributes=True,
        )


def _of_several(sentences: tuple[str, ...]) -> tuple[str, ...]:
    """Give the first of several sentences, and how many more there are."""
    more = len(sentences) - 1
    return sentences if more < 1 else (sentences[0], f"So it is with {more} more function{'s' * (more > 1)}.")
