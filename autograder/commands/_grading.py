"""What every way of grading does: settle on settings and exam, grade, write the reports, print the marks."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import click

if TYPE_CHECKING:
    from collections.abc import Mapping

    from autograder.course import Course
    from autograder.engine.grade import Run
    from autograder.engine.run import Assigned
    from autograder.intake.submission import Submission
    from autograder.sandbox.server import Server
    from autograder.verdicts import Result


def grade_and_report(
    submissions: Sequence[Submission],
    course: Course,
    out: Path,
    *,
    workers: int | None = None,
    seed: int | None = None,
    examples: int | None = None,
    fresh: bool = False,
    time_limit: float | None = None,
    memory: int | None = None,
    output_limit: int | None = None,
    feedback: str | None = None,
    exam_file: Path | None = None,
    min_confinement: str | None = None,
    allow_unconfined: bool = False,
    scheduler: str | None = None,
    merge: bool = False,
    assigned: Mapping[str, Assigned] | None = None,
    server: Server | None = None,
    enter: Callable[[], None] = lambda: None,
) -> Run:
    """Grade with the course's settings but for those given, and write the reports into `out`.

    The reports hold everybody who belongs to the folder. `merge` says that some of them are not among
    `submissions` and keep their results; `assigned` says whose each submission is; `enter` writes down who was
    handed in, once it is sure that this folder can be graded.
    """
    from dataclasses import replace

    import msgspec

    from autograder.commands._exam import exam_for
    from autograder.commands._progress import progress
    from autograder.commands._reporting import say, show_changes, write_all
    from autograder.commands.report import stored_results
    from autograder.engine.grade import Settings, grade
    from autograder.marking.folder import stored_course
    from autograder.marking.marks import read_marks
    from autograder.marking.overrides import read_overrides

    # What is wrong with these files is better known before an hour of grading than after it.
    read_marks(out)
    read_overrides(out)
    if feedback is not None:
        course = replace(course, feedback=cast("Any", feedback), before_due=None)
    course = replace(course, memory_mib=memory or course.memory_mib, output_mib=output_limit or course.output_mib)
    last = stored_course(out)
    if last is not None and last != course:
        say(
            f"{out} was written with other settings of the course; those of this command hold now, for everybody in it."
        )
    seed = course.seed if seed is None else seed
    exam = exam_for(out, exam_file, seed, examples, merge=merge)
    enter()
    given: dict[str, Any] = {
        "seed": (seed or 0) if exam is None else exam.seed,
        "examples": (examples or course.examples) if exam is None else exam.examples,
        "time_limit": time_limit or course.time_limit,
        "feedback": feedback or course.feedback,
        "min_confinement": min_confinement or course.min_confinement,
    }
    settings = Settings(workers=workers, fresh=fresh, allow_unconfined=allow_unconfined, scheduler=scheduler, **given)
    with progress() as report:
        run = grade(submissions, course, settings, out, report, assigned, exam, server)
    results = stored_results(out) if run.results else ()
    record = msgspec.to_builtins(run.record)
    whole = not run.interrupted
    found, moved = write_all(out, results, record, course, feedback=feedback, strict=False, complete=whole)
    show_changes(moved, quiet=True)
    return replace(run, results=found.results)


def print_results(results: Sequence[Result], out: Path, as_json: bool) -> None:
    """Print results to stdout, and to stderr where the files are."""
    if as_json:
        import msgspec

        for result in results:
            click.echo(msgspec.json.encode(result))
        return
    from autograder.reports.terminal import console, print_class

    print_class(results, console())
    names = [
        name for name in ("grades.csv", "report.html", "written.html", "feedback", "results") if (out / name).exists()
    ]
    click.echo(f"\nWrote {', '.join(str(out / name) for name in names)}.", err=True)
