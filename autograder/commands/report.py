"""`autograder report`: every report again from stored results, without running anybody's code."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from autograder.course import Course
    from autograder.verdicts import Result

_MOST_LINES = 20


@click.command()
@click.argument("out", type=click.Path(path_type=Path), metavar="OUT")
@click.option(
    "--course", "course_file", type=click.Path(path_type=Path), metavar="FILE", help="Settings of the course."
)
@click.option(
    "--feedback",
    type=click.Choice(("full", "hint", "score")),
    help="How much students are shown. [default: as in the run]",
)
@click.option(
    "--format",
    "kind",
    type=click.Choice(("table", "md")),
    default="table",
    show_default=True,
    help="What to print: the class as a table, or a forum post that names nobody.",
)
@click.option(
    "--marks",
    "marks_file",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Take the points and comments of written answers from this filled sheet (OUT/written.csv).",
)
@click.option(
    "--forget",
    multiple=True,
    metavar="NAME",
    help="Drop a submission for good, such as one that is kept aside; may be given again.",
)
@click.option("--anonymous", is_flag=True, help="Replace the names on written.html and written.csv.")
@click.option("--json", "as_json", is_flag=True, help="One result object a line to stdout, and no table.")
def command(
    out: Path,
    course_file: Path | None,
    feedback: str | None,
    kind: str,
    marks_file: Path | None,
    forget: Sequence[str],
    anonymous: bool,
    as_json: bool,
) -> None:
    """Write all reports of a run again, from its stored results.

    OUT is the folder of an earlier `autograder grade`. Nobody's code is run. Merged in are the points and rules of
    the course file, marks of written answers, and OUT/overrides.csv. Whose total moves is shown.

    \b
    autograder report graded
    autograder report graded --course course.toml
    autograder report graded --anonymous
    autograder report graded --marks graded/written.csv
    autograder report graded --feedback hint
    autograder report graded --forget ada
    autograder report graded --format md > post.md
    """
    from autograder.commands._grading import print_results
    from autograder.commands._reporting import show_changes, write_all
    from autograder.marking import members

    if forget:
        members.forget(out, forget)
    stored = stored_results(out)
    course = course_of(out, course_file)
    if marks_file is not None:
        _take(out, stored, course, marks_file)
    found, moved = write_all(out, stored, stored_record(out), course, feedback=feedback, anonymous=anonymous)
    results = found.results
    if kind == "md" and not as_json:
        from autograder.reports.markdown import class_markdown

        click.echo(class_markdown(results, course.title), nl=False)
    else:
        print_results(results, out, as_json)
    show_changes(moved, quiet=as_json or kind == "md")


def course_of(out: Path, course_file: Path | None) -> Course:
    """Load the settings that are given, or those that were last used in a folder."""
    from autograder.course import load_course
    from autograder.marking.folder import stored_course

    return load_course(course_file) if course_file is not None else stored_course(out) or load_course(None)


def _take(out: Path, stored: Sequence[Result], course: Course, path: Path) -> None:
    """Read a filled sheet into the marks of the run; say what is still empty."""
    from autograder.commands._reporting import say
    from autograder.marking.anonymous import read_key
    from autograder.marking.folder import decided
    from autograder.marking.marks import write_marks
    from autograder.marking.sheet import read_sheet

    now = decided(out, stored, course)
    filled = read_sheet(path, now.answers(), read_key(out))
    marks = {**now.marks, **{mark.key: mark for mark in filled.marks}}
    write_marks(out, marks.values())
    changed = sum(now.marks.get(mark.key) != mark for mark in filled.marks)
    say(f"{path}: {len(filled.marks)} marks, {changed} of them new or changed.")
    for line, reason in filled.empty[:_MOST_LINES]:
        say(f"{path}, line {line}: {reason}; it stays provisional.")
    if len(filled.empty) > _MOST_LINES:
        say(f"{path}: {len(filled.empty) - _MOST_LINES} more lines have no points.")


def stored_results(out: Path) -> tuple[Any, ...]:
    """Read the results of everybody who belongs to a folder, sorted; what cannot be read is said and left out."""
    import msgspec

    from autograder.errors import UsageError
    from autograder.marking.members import read_members
    from autograder.verdicts import decode

    aside = set(read_members(out).aside)
    paths = sorted(path for path in (out / "results").glob("[!.]*.json") if path.stem not in aside)
    if not paths:
        raise UsageError(f"{out} holds no results; expected the folder that `autograder grade ... -o OUT` wrote.")
    results = {}
    for path in paths:
        try:
            result = decode(path.read_bytes())
        except (OSError, msgspec.MsgspecError) as error:
            click.echo(f"autograder: {path} is left out, it cannot be read as a result ({error}).", err=True)
            continue
        if result.submission == path.stem:  # else somebody has renamed it, and it would count twice
            results[result.submission] = result
    return tuple(results[name] for name in sorted(results))


def stored_record(out: Path) -> dict[str, Any]:
    """Read run.json; an empty record where there is none."""
    import json

    try:
        record = json.loads((out / "run.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return record if isinstance(record, dict) else {}
