"""`autograder report`: every report again from stored results, without running anybody's code."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click


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
@click.option("--json", "as_json", is_flag=True, help="One result object a line to stdout, and no table.")
def command(out: Path, course_file: Path | None, feedback: str | None, kind: str, as_json: bool) -> None:
    """Write all reports of a run again, from its stored results.

    OUT is the folder of an earlier `autograder grade`. Nobody's code is run.

    \b
    autograder report graded
    autograder report graded --feedback hint
    autograder report graded --format md > post.md
    """
    from autograder.commands.grade import print_results
    from autograder.course import load_course
    from autograder.reports.folder import write_reports

    results = stored_results(out)
    record = stored_record(out)
    course = load_course(course_file)
    shown: Any = feedback or (record.get("settings") or {}).get("feedback") or course.feedback
    write_reports(results, out, record, stages=course.stages, feedback=shown, course=course.title)
    if kind == "md" and not as_json:
        from autograder.reports.markdown import class_markdown

        click.echo(class_markdown(results, course.title), nl=False)
    else:
        print_results(results, out, as_json)


def stored_results(out: Path) -> tuple[Any, ...]:
    """Read every result of a run, sorted; what cannot be read is named on stderr and left out."""
    import msgspec

    from autograder.errors import UsageError
    from autograder.verdicts import decode

    paths = sorted((out / "results").glob("[!.]*.json"))
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
