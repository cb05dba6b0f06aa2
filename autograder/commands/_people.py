"""Whose each submission is, and on which numbers it is judged: roster and ledger beside the uploads."""

from __future__ import annotations

import csv
import io
import shlex
from collections.abc import Iterable, Mapping, Sequence, Set
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
_STAFF_NOTE = "Whose submission this is was told by the course staff"
_LISTED = 5


owner_option = click.option(
    "--is",
    "given",
    multiple=True,
    metavar="UPLOAD=ID",
    help="Whose a submission is, by its name in grades.csv, where the uploads do not say or staff know better; "
    "may be given again. It is remembered in OUT; UPLOAD= takes it back.",
)


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
            help="The class: says whose each submission is, and who has handed in nothing. Its student_id is the SID "
            "of Gradescope, the student of nbgrader, the folder's or file's name of plain folders. Canvas and Moodle "
            "have numbers of their own, so there the name says it, or a column canvas_id or moodle_id.",
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


def decisions(pairs: Iterable[str]) -> dict[str, str]:
    """Read UPLOAD=ID; an empty ID takes a decision back."""
    found: dict[str, str] = {}
    for text in pairs:
        name, sign, student = text.rpartition("=")
        if not sign or not name:
            raise click.UsageError(f"--is {text!r}: expected UPLOAD=ID, such as --is jane=1017.")
        found[name] = student.strip()
    return found


def decide(
    submissions: Sequence[Submission], people: People | None, pairs: Iterable[str], out: Path
) -> tuple[dict[str, Assigned] | None, dict[str, str]]:
    """Assign, with what staff say now and have said before for this folder; return that, too, to be kept."""
    from autograder.marking.owners import decide as decide_owners

    students = None if people is None else [one.student_id for one in people.students]
    owners = decide_owners(out, decisions(pairs), {one.id for one in submissions}, students)
    return (assign(submissions, people, owners) if people is not None or owners else None), owners


def assign(
    submissions: Sequence[Submission], people: People | None, given: Mapping[str, str] | None = None
) -> dict[str, Assigned]:
    """Match submissions to students, and give each the student's variant and what to say about the match.

    `given` is what staff have decided; where there is no class to match with, it is all that is known.
    """
    from autograder.engine.run import Assigned
    from autograder.problems.copied import Numbers
    from autograder.problems.matching import STAFF, Upload, match
    from autograder.problems.variants import published

    given = given or {}
    if people is None:
        return {
            one.id: Assigned(published(), given[one.id], note=f"{_STAFF_NOTE}.", by=STAFF, account=_account(one))
            for one in submissions
            if one.id in given
        }
    ids = {student.student_id.casefold() for student in people.students}
    entries = people.ledger
    owners = {variant.identifier: variant.student_id for variant in entries or ()}
    owners.pop(published().identifier, None)
    others = None if entries is None else Numbers(entries)
    uploads = [Upload(one.id, one.path, one.variant, one.owner, one.file) for one in submissions]
    spoken = {one.submission: one.student_id for one in match(uploads, people.students, owners)} if given else {}
    assigned = {}
    for one, found in zip(submissions, match(uploads, people.students, owners, given), strict=True):
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
            found.by,
            # staff who say that it is somebody else's than the platform says mean that person's row everywhere
            account=_account(one) if spoken.get(one.id) in {None, found.student_id} else "",
            free=(one.student_id or "").casefold() not in ids,
        )
    return assigned


def _account(one: Submission) -> str:
    return "" if one.owner is None else one.owner.account


def _note(found: Match, has_variant: bool, variants: bool) -> str:
    """Say how a submission was matched; the student may read it, so it names nobody where there is doubt."""
    from autograder.problems.matching import STAFF

    if found.student_id is None:
        words = "It was not clear whose submission this is"
    elif found.by == STAFF:
        words = _STAFF_NOTE
    elif found.note:  # it may be somebody else's, whose page this would then be
        words = f"Whose submission this is was told by the {found.by}"
    else:
        words = f"Taken for the submission of {found.student_id}, going by the {found.by}"
    return f"{words}{'' if has_variant or not variants else '; the answers were judged on the worked example'}."


def _flag(remarks: Sequence[str]) -> str:
    """Make a sentence; an id that begins it keeps its small letter."""
    words = "; ".join(remarks)
    start = words[:1].upper() if words.startswith(("the ", "it ")) else words[:1]
    return f"{start}{words[1:]}." if words else ""


def report_missing(people: People, assigned: Mapping[str, Assigned], out: Path, graded: Set[str] = frozenset()) -> None:
    """List on stderr, and in OUT/missing.csv, who has handed in nothing; `graded` are ids with a result in OUT."""
    from autograder.reports.gradebook import defused
    from autograder.writing import write_whole

    found = graded | {one.student_id for one in assigned.values()}
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
        option = shlex.join(("--is", f"{nobodys[0]}=ID"))
        words = "1 submission is" if len(nobodys) == 1 else f"{len(nobodys)} submissions are"
        click.echo(f"{words} nobody's of the class: {_first(nobodys)}; say whose with {option}.", err=True)
    if nobodys and len(nobodys) == len(assigned):
        click.echo("Nobody of the roster has handed in anything: is it the roster of this class?", err=True)


def _some(students: Sequence[Student]) -> str:
    return _first([f"{one.student_id} ({one.name})" if one.name else one.student_id for one in students])


def _first(names: Sequence[str]) -> str:
    from autograder.reports.wording import visible

    return ", ".join(visible(name) for name in names[:_LISTED]) + (", ..." if len(names) > _LISTED else "")
