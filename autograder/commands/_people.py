"""Whose each submission is, and on which numbers it is judged: roster and ledger beside the uploads."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import click

from autograder.commands._class import Function, secret_options

if TYPE_CHECKING:
    from autograder.course import Course
    from autograder.engine.run import Assigned
    from autograder.intake.submission import Submission
    from autograder.problems.ledger import Ledger
    from autograder.problems.matching import Match
    from autograder.problems.roster import Student
    from autograder.problems.secret import Secret

MISSING = "missing.csv"
_LISTED = 5


def people_options(function: Function) -> Function:
    """Add what says whose each submission is, and on which numbers it is judged."""
    for option in (
        secret_options(required=False),
        click.option(
            "--ledger",
            type=click.Path(path_type=Path),
            metavar="FILE",
            help="variants.csv of the release: the numbers that answers are judged on. "
            "[default: drawn again from roster, term and secret]",
        ),
        click.option(
            "--roster",
            type=click.Path(path_type=Path),
            metavar="CSV",
            help="The class: says whose each submission is, and who has handed in nothing.",
        ),
    ):
        function = option(function)
    return function


@dataclass(frozen=True)
class People:
    """The class that a run is graded for.

    Parameters
    ----------
    students : sequence of Student
        Who may hand in.
    ledger : Ledger or None
        Who got which numbers; None where everybody has the worked example.
    """

    students: Sequence[Student]
    ledger: Ledger | None


def people_of(
    roster: Path | None,
    ledger: Path | None,
    secret: Secret | None,
    term: str | None,
    families: Sequence[str],
    course: Course,
) -> People | None:
    """Read the class; None where neither roster nor ledger is given.

    The ledger of the release says who got which numbers. Without one they are drawn again from
    roster, secret and term, as a first release of that roster would have drawn them.
    """
    from autograder.commands._class import drawn_ledger, mix_of
    from autograder.commands._progress import shown
    from autograder.problems.ledger import read_ledger
    from autograder.problems.roster import Student, read_roster

    if roster is None and ledger is None:
        return None
    entries = None if ledger is None else read_ledger(ledger)
    if roster is None:
        return People([Student(variant.student_id) for variant in entries or ()], entries)
    students = read_roster(roster)
    if entries is None and secret is not None and term is not None:
        with ExitStack() as stack:
            show = shown(stack, "drawing", "drew")
            entries = drawn_ledger(students, secret, term, mix_of(families, course), show)
    return People(students, entries)


def assign(submissions: Sequence[Submission], people: People) -> dict[str, Assigned]:
    """Match submissions to students, and give each the student's variant and what to say about the match."""
    from autograder.engine.run import Assigned
    from autograder.problems.copied import Numbers
    from autograder.problems.matching import Upload, match
    from autograder.problems.variants import published

    entries = people.ledger
    owners = {variant.identifier: variant.student_id for variant in entries or ()}
    owners.pop(published().identifier, None)
    others = None if entries is None else Numbers(entries)
    uploads = [Upload(one.id, one.path, one.variant) for one in submissions]
    assigned = {}
    for found in match(uploads, people.students, owners):
        own = None if entries is None or found.student_id is None else entries.get(found.student_id)
        flags = [found.note] if found.note else []
        if entries is not None and found.student_id is not None and own is None:
            flags.append(f"{found.student_id} has no variant on record")
        assigned[found.submission] = Assigned(
            own or published(),
            found.student_id,
            others,
            _note(found, own is not None, entries is not None),
            _flag(flags),
        )
    return assigned


def _note(found: Match, has_variant: bool, variants: bool) -> str:
    """Say how a submission was matched; the student may read it."""
    if found.student_id is None:
        words = "It was not clear whose submission this is"
    else:
        words = f"Taken for the submission of {found.student_id}, going by the {found.by}"
    return f"{words}{'' if has_variant or not variants else '; the answers were judged on the worked example'}."


def _flag(remarks: Sequence[str]) -> str:
    """Make a sentence; an id that begins it keeps its small letter."""
    words = "; ".join(remarks)
    start = words[:1].upper() if words.startswith(("the ", "it ")) else words[:1]
    return f"{start}{words[1:]}." if words else ""


def report_missing(people: People, assigned: Mapping[str, Assigned], out: Path) -> None:
    """List on stderr, and in OUT/missing.csv, who has handed in nothing."""
    from autograder.reports.gradebook import defused
    from autograder.writing import write_whole

    found = {one.student_id for one in assigned.values()}
    missing = [student for student in people.students if student.student_id not in found]
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(("student_id", "name", "email"))
    writer.writerows([defused(cell) for cell in (one.student_id, one.name, one.email)] for one in missing)
    write_whole(out / MISSING, file.getvalue().encode())
    nobodys = sorted(name for name, one in assigned.items() if one.student_id is None)
    total = len(people.students)
    if missing:
        click.echo(f"\nNo submission from {len(missing)} of {total} students: {_some(missing)}.", err=True)
        click.echo(f"They are listed in {out / MISSING}.", err=True)
    if nobodys:
        click.echo(f"{len(nobodys)} submissions name nobody of the class: {_first(nobodys)}.", err=True)


def _some(students: Sequence[Student]) -> str:
    return _first([f"{one.student_id} ({one.name})" if one.name else one.student_id for one in students])


def _first(names: Sequence[str]) -> str:
    from autograder.reports.wording import visible

    return ", ".join(visible(name) for name in names[:_LISTED]) + (", ..." if len(names) > _LISTED else "")
