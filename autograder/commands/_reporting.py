"""What `grade` and `report` have in common: results merged with what people decided, written as every report."""

from __future__ import annotations

import shlex
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from autograder.course import Course
    from autograder.engine.grade import Run
    from autograder.marking.folder import Decided
    from autograder.reports.changes import Change
    from autograder.verdicts import Result


def write_all(
    out: Path,
    stored: Sequence[Result],
    record: Mapping[str, Any],
    course: Course,
    *,
    feedback: Any = None,
    anonymous: bool = False,
    strict: bool = True,
    complete: bool = True,
) -> tuple[Decided, list[Change]]:
    """Merge, write every report into `out`, and keep the settings in force there; return whose total moved.

    `strict` makes an override that changes nothing an error, `complete` says that `stored` is the whole class.
    """
    from datetime import UTC, datetime

    from autograder.marking.folder import decided, store_course
    from autograder.marking.showing import shown_at
    from autograder.reports.changes import changes, read_totals, write_changes
    from autograder.reports.folder import write_reports

    before = read_totals(out / "grades.csv")
    found = decided(out, stored, course, strict=strict, complete=complete)
    shown = shown_at(course, datetime.now(UTC), feedback)
    write_reports(
        *(found.results, out, record),
        stages=course.stages,
        feedback=shown.policy,
        course=course.title,
        later=shown.later,
    )
    _write_answers(out, found, anonymous)
    store_course(out, course)
    for note in found.notes:
        say(note)
    moved = changes(before, found.results)
    if moved:
        write_changes(moved, out)
    return found, moved


def _write_answers(out: Path, found: Decided, anonymous: bool) -> None:
    """Write written.html and written.csv; a sheet with points that nobody has read back is left alone."""
    from autograder.marking.anonymous import anonymous_names, read_key
    from autograder.marking.sheet import FILE, LAST, sheet_text, unread
    from autograder.writing import write_whole

    key = {submission: name for name, submission in read_key(out).items()}
    names = None
    if anonymous:
        names = key = anonymous_names(out, [result.submission for result in found.stored])
    answers = found.answers(names)
    if not answers and not (out / FILE).exists():
        return
    from autograder.reports.written import written_page

    title, guide = found.course.title, found.course.guide
    write_whole(out / "written.html", written_page(answers, title, guide, anonymous).encode())
    if unread(out / FILE, answers, key):
        say(
            f"{out / FILE} holds marks that are not read yet and was not written over; "
            f"take them: {shlex.join(('autograder', 'report', str(out), '--marks', str(out / FILE)))}"
        )
    else:
        for name in (LAST, FILE):
            write_whole(out / name, sheet_text(answers).encode())


def say(note: str) -> None:
    """Put a note on stderr, safely."""
    from autograder.reports.wording import visible

    click.echo(f"autograder: {visible(note)}", err=True)


def show_changes(moved: Sequence[Change], quiet: bool) -> None:
    """Say whose total moved: on stdout, or on stderr where stdout is data."""
    from autograder.reports.changes import changes_text

    if moved:
        click.echo(f"\n{changes_text(moved)}", err=quiet)


def exit_code(run: Run) -> int:
    """Return 130 for an interrupted run, 3 where something could not be graded, else 0."""
    if run.interrupted:
        click.echo(
            f"autograder: Interrupted: {run.record.graded_now + run.record.reused} of {run.record.submissions} are "
            "graded and kept; "
            "the same command goes on from there.",
            err=True,
        )
        return 130
    broken = [result.submission for result in run.results if result.status == "grader_error"]
    if broken:
        click.echo(
            f"autograder: {len(broken)} could not be graded, through no fault of the student "
            f"({', '.join(broken[:3])}{', ...' if len(broken) > 3 else ''}); see results/ and `autograder doctor`.",
            err=True,
        )
        return 3
    return 0
