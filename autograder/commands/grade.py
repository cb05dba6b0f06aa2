"""`autograder grade`: a folder of uploads in, marks with reasons out."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from autograder.commands._people import owner_option, people_options

if TYPE_CHECKING:
    from autograder.intake.submission import Submission

LEVELS = ("full", "seccomp", "none")
POLICIES = ("full", "hint", "score")


@click.command()
@click.argument("paths", nargs=-1, required=True, type=click.Path(path_type=Path), metavar="PATH...")
@click.option(
    "-o",
    "--output",
    "out",
    required=True,
    type=click.Path(path_type=Path),
    metavar="OUT",
    help="Folder for the results; made where it is missing.",
)
@click.option(
    "--course",
    "course_file",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Settings of the course; `autograder init` writes one to edit. [default: what it writes]",
)
@click.option(
    "--workers", type=click.IntRange(1), metavar="N", help="Submissions graded at a time. [default: one a core]"
)
@click.option(
    "--seed",
    type=click.IntRange(0),
    metavar="S",
    help="Which cases are drawn: the same seed gives the same marks. "
    "[default: the course's, else derived from secret and term, else 0]",
)
@people_options
@owner_option
@click.option(
    "--examples", type=click.IntRange(1), metavar="N", help="Cases drawn a stage. [default: the course's, or 200]"
)
@click.option(
    "--exam",
    "exam_file",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Grade with this exam (see: autograder exam). [default: the one kept in OUT, else one is drawn]",
)
@click.option(
    "--only",
    multiple=True,
    metavar="ID",
    help="Grade only this submission, by its name in grades.csv; may be given again.",
)
@click.option("--anyway", is_flag=True, help="Go on where the uploads carry variants that nobody was given.")
@click.option("--fresh", is_flag=True, help="Grade everything again, whatever is stored in OUT.")
@click.option(
    "--time-limit",
    type=click.FloatRange(0, 600, min_open=True),
    metavar="SECONDS",
    help="Computing time of a check; a submission gets four times as much. [default: the course's, or 2]",
)
@click.option(
    "--memory",
    type=click.IntRange(64, 65_536),
    metavar="MIB",
    help="Memory that a submission may take. [default: the course's, or 512]",
)
@click.option(
    "--output-limit",
    type=click.IntRange(1, 1024),
    metavar="MIB",
    help="What a submission may print; it is thrown away. [default: the course's, or 16]",
)
@click.option(
    "--feedback",
    type=click.Choice(POLICIES),
    help="What students are shown: a failing case, its right value and a hint; the hint only; marks only. "
    "[default: the course's, or full]",
)
@click.option(
    "--scheduler", metavar="ADDRESS", help="Grade on the dask cluster of this scheduler, such as tcp://host:8786."
)
@click.option(
    "--min-confinement",
    type=click.Choice(LEVELS),
    help="Refuse to grade where `autograder doctor` finds less. [default: the course's, or seccomp]",
)
@click.option(
    "--allow-unconfined", is_flag=True, help="Grade even where nothing can be locked: only code that you trust."
)
@click.option("--json", "as_json", is_flag=True, help="One result object a line to stdout, and no table.")
def command(
    paths: Sequence[Path],
    out: Path,
    course_file: Path | None,
    roster: Path | None,
    ledger: Path | None,
    term: str | None,
    secret_file: Path | None,
    families: Sequence[str],
    given: Sequence[str],
    only: Sequence[str],
    as_json: bool,
    anyway: bool,
    **options: Any,
) -> int:
    """Grade files, folders of files, or both.

    Reads .py and .ipynb, grades every submission in a locked process, and writes OUT/grades.csv,
    OUT/report.html, OUT/feedback/ for students, OUT/results/ for staff, OUT/run.json and OUT/exam.
    A second run takes the same exam and grades only what is new or changed.

    \b
    autograder grade uploads/ -o graded
    autograder grade alice.py bob.ipynb -o graded
    autograder grade uploads/ -o graded --course course.toml --seed 2026
    autograder grade uploads/ -o graded --exam midterm.exam
    autograder grade uploads/ -o graded --only alice
    autograder grade uploads/ -o graded --roster class.csv --is plato_17=s1042
    autograder grade uploads/ -o graded --roster class.csv --ledger release/staff/variants.csv
    autograder grade uploads/ -o graded --roster class.csv --term 2026S --secret-file secret.txt
    autograder grade uploads/ -o graded --json | jq .score

    Exit code: 0 done, whatever the marks; 2 nothing could be read; 3 something could not be graded
    through no fault of the student; 130 interrupted (results so far are kept).
    """
    from autograder.commands._early import early_server

    server = click.get_current_context().with_resource(early_server(paths, out, options["scheduler"]))
    from autograder.commands._class import secret_of
    from autograder.commands._contradiction import check_variants
    from autograder.commands._grading import grade_and_report, print_results
    from autograder.commands._people import decide, people_of, report_missing
    from autograder.commands._reporting import exit_code, say
    from autograder.course import load_course
    from autograder.intake.submission import collect
    from autograder.marking.members import enter_members, members_after
    from autograder.marking.owners import store_owners
    from autograder.writing import make_folder

    course = load_course(course_file)
    if course_file is not None:
        options["examples"] = options["examples"] or course.examples
    secret = secret_of(term, secret_file)
    everything = collect(list(paths))
    submissions = _chosen(everything, only)
    people = people_of(roster, ledger, secret, term, families, course)
    if note := check_variants(everything, None if people is None else people.ledger, anyway=anyway):
        say(note)
    assigned, owners = decide(everything, people, given, out)
    if secret is not None and term is not None and course.seed is None and options["seed"] is None:
        options["seed"] = secret.seed(term)
    class_ids = () if people is None or roster is None else [one.student_id for one in people.students]
    change = members_after(out, paths, [one.id for one in everything], class_ids, some=bool(only))

    def enter() -> None:
        make_folder(out)
        store_owners(out, owners)
        enter_members(out, change)
        for note in change.notes:
            say(note)

    merge = bool(only) or bool(change.staying)
    run = grade_and_report(
        submissions, course, out, merge=merge, assigned=assigned, server=server, enter=enter, **options
    )
    print_results(run.results, out, as_json)
    if people is not None and assigned is not None:
        report_missing(people, assigned, out, {one.student_id for one in run.results if one.student_id})
    return exit_code(run)


def _chosen(submissions: list[Submission], only: Sequence[str]) -> list[Submission]:
    if not only:
        return submissions
    known = {submission.id for submission in submissions}
    for name in only:
        if name not in known:
            import difflib

            from autograder.errors import UsageError

            near = difflib.get_close_matches(name, known, 1)
            guess = f"did you mean {near[0]}?" if near else f"the first of them is {min(known)}."
            raise UsageError(f"--only {name}: none of the {len(known)} submissions has this name; {guess}")
    return [submission for submission in submissions if submission.id in only]
