"""A table for mail-merge programs: one line a student, with the score and the feedback in words."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence

from autograder.errors import UsageError
from autograder.exports.pairing import Person, listing, pair
from autograder.exports.words import feedback_text, general
from autograder.problems.roster import Student
from autograder.reports.feedback import Policy
from autograder.reports.gradebook import defused, exact
from autograder.verdicts import Result

COLUMNS = ("submission", "student_id", "name", "email", "status", "score", "max_score", "note", "page", "feedback")


def mailmerge(
    results: Sequence[Result],
    students: Sequence[Student] = (),
    *,
    policy: Policy = "full",
    course: str = "1D SLAM",
    later: str = "",
    given: Mapping[str, str] | None = None,
) -> tuple[str, list[str]]:
    """Lay out the table; return it with what a human should know.

    With a roster there is a line for each of its students who handed in, with name and address; without
    one there is a line for each result, and these are empty.

    Parameters
    ----------
    results : sequence of Result
        What was graded.
    students : sequence of Student
        The roster, if there is one.
    policy : {"full", "hint", "score"}
        How much the feedback says.
    course : str
        Title of the homework.
    later : str
        What students are told of what follows, and when.
    given : mapping, optional
        Submission -> student id, where a human has decided.
    """
    if not results:
        raise UsageError("There is no result to write about; grade first.")
    notes: list[str] = []
    owner: dict[str, Student] = {}
    if students:
        people = [Person(one.line, tuple(filter(None, (one.student_id, one.email))), (), one.name) for one in students]
        pairs = pair(results, people, "the roster", given)
        by_line = {student.line: student for student in students}
        owner = {result.submission: by_line[line] for line, result in pairs.by_line.items()}
        if pairs.strangers:
            notes.append(
                f"Not in the roster, so without address: {listing([one.submission for one in pairs.strangers])}."
            )
        missing = [student.student_id for student in students if student.line not in pairs.by_line]
        if missing:
            notes.append(f"Without a result, so without a line: {listing(missing)}.")
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(COLUMNS)
    for result in results:
        student = owner.get(result.submission)
        text = feedback_text(result, policy, course, later).rstrip("\n")
        first, _, rest = text.partition("\n")
        writer.writerow(
            [
                defused(result.submission),
                defused(student.student_id if student else result.student_id or ""),
                defused(student.name if student else ""),
                defused(student.email if student else ""),
                result.status,
                "" if result.score is None else exact(result.score),
                exact(result.max_score),
                defused(general(result)),
                defused(f"feedback/{result.submission}.html"),
                f"{defused(first)}\n{rest}" if rest else defused(first),
            ]
        )
    return file.getvalue(), notes
