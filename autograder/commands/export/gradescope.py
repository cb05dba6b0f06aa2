"""`autograder export gradescope`: the autograder.zip to upload to a programming assignment."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click


@click.command()
@click.option(
    "--course", "course_file", type=click.Path(path_type=Path), metavar="FILE", help="Settings of the course."
)
@click.option("--ledger", type=click.Path(path_type=Path), metavar="CSV", help="variants.csv of the release.")
@click.option(
    "--roster",
    type=click.Path(path_type=Path),
    metavar="CSV",
    help="Whose address is which student_id, where the ledger's ids are no addresses.",
)
@click.option(
    "--seed", type=click.IntRange(0), metavar="S", help="Which cases are drawn. [default: the course's, or 0]"
)
@click.option("--examples", type=click.IntRange(1), metavar="N", help="Cases a stage. [default: the course's]")
@click.option(
    "--feedback",
    type=click.Choice(("full", "hint", "score")),
    help="How much a failed test says. [default: the course's, at the time]",
)
@click.option(
    "--visibility",
    type=click.Choice(("visible", "after_due_date", "after_published")),
    default="visible",
    show_default=True,
    help="From when on students see their results, all of them alike.",
)
@click.option(
    "--lock", type=click.Path(path_type=Path), metavar="FILE", help="Versions to install. [default: requirements.lock]"
)
@click.option(
    "-o",
    "--output",
    "path",
    type=click.Path(path_type=Path),
    default=Path("autograder.zip"),
    metavar="ZIP",
    show_default=True,
    help="File to write.",
)
def command(
    course_file: Path | None,
    ledger: Path | None,
    roster: Path | None,
    seed: int | None,
    examples: int | None,
    feedback: str | None,
    visibility: str,
    lock: Path | None,
    path: Path,
) -> None:
    """Write the autograder.zip of a programming assignment on Gradescope.

    It holds this grader, the locked versions and the rules of the course; a submission gets the same marks there as
    from `autograder grade` with the same seed. With the ledger of a release everybody is judged on the variant on
    record; the secret of the term is not needed and never in it.

    \b
    autograder export gradescope -o autograder.zip
    autograder export gradescope --course course.toml --seed 2026 -o autograder.zip
    autograder export gradescope --ledger release/variants.csv --roster class.csv -o autograder.zip
    """
    from autograder.commands.export._shared import read, say
    from autograder.course import load_course
    from autograder.exports.gradescope.archive import MEMORY_MIB, Rules, autograder_zip
    from autograder.exports.gradescope.submitter import slim_roster
    from autograder.problems.ledger import read_ledger
    from autograder.problems.roster import read_roster
    from autograder.writing import write_whole

    course = load_course(course_file)
    choices: dict[str, Any] = {"feedback": feedback, "visibility": visibility}
    rules = Rules(
        seed=seed if seed is not None else (course.seed or 0),
        examples=examples or course.examples,
        time_limit=course.time_limit,
        memory_mib=min(course.memory_mib, MEMORY_MIB),
        min_confinement=course.min_confinement,
        **choices,
    )
    notes = []
    students = read_roster(roster) if roster is not None else []
    if ledger is not None:
        known = read_ledger(ledger)
        missing = [one.student_id for one in students if one.student_id not in known]
        if missing:
            notes.append(f"{len(missing)} students of the roster have no variant: {', '.join(missing[:5])}.")
    data, origin = autograder_zip(
        rules,
        course=read(course_file, "a course file") if course_file is not None else b"",
        ledger=read(ledger, "the variants.csv of a release") if ledger is not None else b"",
        roster=slim_roster(students),
        lock=lock,
    )
    write_whole(path, data)
    say([f"{path}: {len(data) / 1000:.0f} kB, with {origin}.", *notes], [path])
