"""A release on its way to the students: a table for mail merge, and archives that Moodle and Canvas hand out.

Whoever cannot be told from others gets nothing: a file in the wrong hands is worse than one that is missing.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from autograder.errors import UsageError
from autograder.exports.bundle import bundle
from autograder.exports.canvas.feedback import newest_uploads
from autograder.exports.moodle.worksheet import folder_name, participants
from autograder.exports.pairing import Person, listing
from autograder.problems.roster import Student
from autograder.reports.gradebook import defused

COLUMNS = ("student_id", "name", "email", "attachment", "subject", "text")


@dataclass(frozen=True)
class HandedOut:
    """An archive to upload, and what a human should know."""

    data: bytes
    notes: tuple[str, ...]


def mail_table(students: Sequence[Student], title: str, due: str = "") -> str:
    """Write a line for each student: the address, the file to attach, and what the mail says.

    Parameters
    ----------
    students : sequence of Student
        The roster.
    title : str
        Title of the homework.
    due : str
        When it is due, in words; "" where nothing is.
    """
    until = f" Hand in one file until {due}." if due else " Hand in one file."
    text = f"your problem of {title} is in the attached archive; begin with handout.html in it.{until}"
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(COLUMNS)
    for one in students:
        name = one.name or one.student_id
        words = (one.student_id, one.name, one.email, f"zips/{one.student_id}.zip", title, f"Dear {name}, {text}")
        writer.writerow([defused(word) for word in words])
    return file.getvalue()


def moodle_archive(
    worksheet: bytes,
    name: str,
    students: Sequence[Student],
    archives: Mapping[str, bytes],
    headings: Mapping[str, str] | None = None,
) -> HandedOut:
    """Pack everybody's archive as a feedback file of Moodle, which shows it to that student only.

    A student is found by the address, or by a column `moodle_id` of the roster with the participant's number; an
    id of the course never stands for that number.

    Parameters
    ----------
    worksheet, name : bytes, str
        The grading worksheet of an assignment, and what messages call it.
    students : sequence of Student
        The roster.
    archives : mapping
        Student id -> the student's archive.
    headings : mapping, optional
        Heading of a column in a language that is not known.

    Raises
    ------
    UsageError
        Where the file is no worksheet, two students share a line, or nobody is found.
    """
    found: dict[int, tuple[Person, Student]] = {}
    people = participants(worksheet, name, headings or {})
    for student in students:
        fitting = [one for one in people if _is(one, student)]
        if len(fitting) > 1 or (fitting and fitting[0].line in found):
            raise UsageError(
                f"{name}: {student.student_id} shares a line or an address with somebody else; expected every "
                "address once, or a column moodle_id in the roster."
            )
        if fitting:
            found[fitting[0].line] = (fitting[0], student)
    files = {
        f"{folder_name(person.name, person.ids[1])}/{student.student_id}.zip": archives[student.student_id]
        for person, student in found.values()
    }
    return _handed(files, students, [student for _, student in found.values()], name, "an address or moodle_id")


def _is(person: Person, student: Student) -> bool:
    number, addresses = person.ids[1], [one.casefold() for one in person.ids[2:] if one]
    told = student.others.get("moodle_id", "").strip()
    if told:
        return told == number
    return bool(student.email) and student.email.strip().casefold() in addresses


def canvas_archive(
    uploads: Sequence[str], name: str, students: Sequence[Student], archives: Mapping[str, bytes]
) -> HandedOut:
    """Pack everybody's archive under the name of the .zip that the student handed in first.

    Canvas hands a file out only as the answer to an upload, under its name.

    Parameters
    ----------
    uploads : sequence of str
        Names of the files in Canvas's submissions.zip.
    name : str
        What messages call that archive.
    students : sequence of Student
        The roster, with a column `canvas_id`.
    archives : mapping
        Student id -> the student's archive.

    Raises
    ------
    UsageError
        Where the roster has no column canvas_id, a number is there twice, or nobody is found.
    """
    numbers = [student.others.get("canvas_id", "").strip() for student in students]
    known = [number for number in numbers if re.fullmatch(r"\d+", number)]
    if len(set(known)) != len(known) or not known:
        raise UsageError("The roster needs a column canvas_id with Canvas's number of each student, every one once.")
    newest = newest_uploads(uploads, known)
    given = {
        student.student_id: newest[number]
        for student, number in zip(students, numbers, strict=True)
        if number in newest and newest[number].lower().endswith(".zip")
    }
    files = {upload: archives[student] for student, upload in given.items()}
    there = [student for student in students if student.student_id in given]
    return _handed(files, students, there, name, "a .zip of a student with a canvas_id")


def _handed(
    files: Mapping[str, bytes], students: Sequence[Student], there: Sequence[Student], name: str, wanted: str
) -> HandedOut:
    if not files:
        raise UsageError(f"{name} fits nobody of the roster: it holds nowhere {wanted}.")
    without = [student.student_id for student in students if student not in there]
    notes = (f"Not in {name} with {wanted}, so without a file: {listing(without)}.",) if without else ()
    return HandedOut(bundle(files), notes)
