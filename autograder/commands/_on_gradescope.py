"""What autograder.zip runs on Gradescope: one submission in, results.json out, whatever happens.

`python -I -m autograder.commands._on_gradescope ROOT`, where ROOT is /autograder there. A student's code runs in
the locked child of the grader only; it can open no file, so it cannot write results.json.
"""

from __future__ import annotations

import shutil
import sys
import tempfile
import traceback
from collections.abc import Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from autograder.engine.grade import Assigned
    from autograder.exports.gradescope.archive import Rules
    from autograder.intake.submission import Submission
    from autograder.reports.feedback import Policy
    from autograder.sandbox.server import Server
    from autograder.verdicts import Result

NAME = "submission"  # what the one submission is called; no student's name is needed for grading


@dataclass(frozen=True)
class Graded:
    """One result, and what the student should know beside it."""

    result: Result
    notes: tuple[str, ...]
    policy: Policy
    course: str


def main(arguments: Sequence[str]) -> int:
    """Grade what lies below ROOT; 0 where results.json holds the marks, 3 where it says that there are none."""
    from autograder.sandbox.server import Server

    root = Path(arguments[0]).resolve()
    try:
        with closing(Server()) as server:  # it loads while all else is imported and read
            return _write(root, server)
    except Exception:  # noqa: BLE001 - the last resort: run_autograder has left a results.json that says so
        traceback.print_exc()
        return 3


def _write(root: Path, server: Server) -> int:
    from autograder.attempts import Attempts
    from autograder.exports.gradescope.archive import read_rules
    from autograder.exports.gradescope.results import results_json
    from autograder.reports.drawable import without_cases
    from autograder.writing import write_whole

    rules = read_rules(root / "source" / "rules.json")
    graded = grade_submission(root, rules, server)
    written = partial(
        results_json, policy=graded.policy, visibility=rules.visibility, course=graded.course, notes=graded.notes
    )
    attempt = Attempts()
    data = attempt("writing its cases", written, graded.result) or written(without_cases(graded.result))
    print(*attempt.flags, sep="\n", end="", file=sys.stderr)
    (root / "results").mkdir(exist_ok=True)
    write_whole(root / "results" / "results.json", data)
    if graded.result.score is None:
        print(graded.result.message, file=sys.stderr)
        return 3
    return 0


def grade_submission(root: Path, rules: Rules, server: Server | None = None) -> Graded:
    """Grade the uploaded files as the course's rules say, in a fork server that may be starting already."""
    from autograder.course import load_course
    from autograder.engine.exam import read_exam
    from autograder.engine.grade import Settings, grade
    from autograder.marking.showing import shown_at

    source = root / "source"
    course_file = source / "course.toml"
    course = load_course(course_file if course_file.exists() else None)
    course = replace(course, memory_mib=min(course.memory_mib, rules.memory_mib))
    shown = shown_at(course, datetime.now(UTC), rules.feedback)
    options: dict[str, Any] = {"feedback": shown.policy, "min_confinement": rules.min_confinement}
    settings = Settings(
        seed=rules.seed, examples=rules.examples, workers=1, time_limit=rules.time_limit, fresh=True, **options
    )
    assigned, notes = assignment_of(root)
    exam = read_exam(source / "exam") if (source / "exam").exists() else None
    with tempfile.TemporaryDirectory() as folder:
        submission = collected(root / "submission", Path(folder))
        given = {} if assigned is None else {submission.id: assigned}
        run = grade([submission], course, settings, Path(folder) / "graded", assigned=given, exam=exam, server=server)
    return Graded(run.results[0], (*notes, *filter(None, [shown.later])), shown.policy, course.title)


def collected(uploaded: Path, folder: Path) -> Submission:
    """Read the uploaded files as those of one student: of several the one that counts is taken, or none."""
    from autograder.intake.submission import collect

    copy = folder / "uploads" / NAME
    copy.parent.mkdir()
    if uploaded.is_dir():
        shutil.copytree(uploaded, copy, symlinks=True)
    else:
        copy.mkdir()
    found = collect([copy.parent], layout="folder_a_student")
    assert len(found) == 1, [each.path for each in found]
    return replace(found[0], id=NAME, path=NAME)


def assignment_of(root: Path) -> tuple[Assigned | None, tuple[str, ...]]:
    """Find the variant on record of whoever handed in; None where there is no ledger, or nobody is in it."""
    from autograder.engine.grade import Assigned
    from autograder.exports.gradescope.submitter import student_id, submitters
    from autograder.problems.ledger import read_ledger
    from autograder.problems.roster import read_roster

    ledger_file, roster_file = root / "source" / "ledger.csv", root / "source" / "roster.csv"
    if not ledger_file.exists():
        return None, ()
    ledger = read_ledger(ledger_file)
    roster = read_roster(roster_file) if roster_file.exists() else []
    people = submitters(root / "submission_metadata.json")
    found = student_id(people, roster, ledger)
    variant = None if found is None else ledger.get(found)
    if variant is None:
        words = "No variant is on record for your address, so your answers were compared with the worked example. "
        return None, (words + "If you were given a variant of your own, tell the course staff.",)
    notes = (f"Your variant on record is {variant.identifier}.",)
    return Assigned(variant, found), notes


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
