"""What is released after the due date: for every student of a release a page with model answers on their numbers."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from autograder.errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Iterable

    from autograder.course import Course
    from autograder.problems.variants import Variant

FOLDER = "solutions"


def check_time(course: Course, now: datetime) -> None:
    """Refuse as long as somebody can still hand in, or where the course does not say until when.

    Raises
    ------
    UsageError
        Where it is too early, or nobody can know.
    """
    from autograder.marking.clock import clock
    from autograder.marking.showing import last_moment

    last = last_moment(course)
    if last is None:
        raise UsageError("--solutions needs a course file with a due date (--course FILE, `due` in [late]).")
    if now < last:
        raise UsageError(f"--solutions is for after {clock(last, course.zone)}: until then somebody may hand in.")


def release_solutions(variants: Iterable[Variant], out: Path) -> int:
    """Write a page for every student into a folder of its own; return how many there are."""
    from autograder.problems.replacing import replace_file
    from autograder.render.solution import model_answers

    pages = {variant.student_id: model_answers(variant.problem) for variant in variants}
    (out / FOLDER).mkdir(parents=True, exist_ok=True)
    for student_id, page in pages.items():
        replace_file(out / FOLDER / f"{student_id}.html", page.encode())
    return len(pages)
