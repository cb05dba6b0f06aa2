"""The table: every layout, with and without roster and ledger, and what a class hands in: whose it is, what it earns.

What is expected is said by the class below, never read from a path: each student hands in the work that CLASS names.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

import msgspec
import pytest

from autograder.commands._people import People, assign
from autograder.intake.submission import collect
from autograder.problems.families import family
from autograder.problems.ledger import Ledger, write_ledger
from autograder.problems.roster import Student
from autograder.problems.secret import Secret
from autograder.verdicts import Result
from tests.commands.released import SECRET, TERM, module
from tests.intake.making import cell, notebook, write

Ended = tuple[int, str, str]
Files = dict[str, str | bytes]

# module, notebook, somebody else's notebook, two files, a group of two
CLASS = (
    Student("s1001", "Jane Doe", "jane@x.edu"),
    Student("s1002", "John Roe", "john@x.edu"),
    Student("s1003", "Zoë O'Neil-Lu", "zoe@x.edu"),
    Student("s1004", "Plato", "@plato:matrix.example"),
    Student("s1005", "Kim Law", "kim@x.edu"),
    Student("1", "Ann Lee", "ann@x.edu"),
)
GROUP = ("s1005", "1")
COPIED = "s1003"


@pytest.fixture(scope="module")
def ledger() -> Ledger:
    """Draw everybody's numbers."""
    ledger = Ledger()
    ledger.extend(Secret(SECRET.encode()), TERM, {one.student_id: family("A") for one in CLASS})
    return ledger


@pytest.fixture(scope="module")
def work(ledger: Ledger) -> dict[str, Files]:
    """Say who hands in which files; the partner's copy of a group is the same."""
    solved = {variant.student_id: module(variant) for variant in ledger}

    def own(student: str) -> bytes:
        variant = ledger.get(student)
        assert variant is not None
        return notebook(cell(solved[student]), metadata={"slam1d": {"variant": variant.identifier}})

    return {
        "s1001": {"slam1d_with_s1002.py": solved["s1001"]},
        "s1002": {"slam1d-1.ipynb": own("s1002")},
        "s1003": {"slam1d.ipynb": own("s1002")},
        "s1004": {"slam1d.py": solved["s1004"], "explore.ipynb": notebook(cell("x = 1\n"))},
        "s1005": {"s1005.py": solved["s1005"]},
        "1": {"s1005.py": solved["s1005"]},
    }


def squeezed(name: str) -> str:
    """Write a name as Canvas does: last name first, word characters only."""
    first, _, last = name.rpartition(" ")
    return "".join(char for char in (last + first).lower() if char.isalnum())


def canvas(work: Mapping[str, Files]) -> Files:
    """Number the class from 1001 on, so that numbers of Canvas are other students' ids (1 is taken by nobody)."""
    return {
        f"{squeezed(one.name)}_{k}_{9000 + 10 * k + n}_{name}": data
        for k, one in enumerate(CLASS, 1)
        for n, (name, data) in enumerate(work[one.student_id].items())
    }


def moodle(work: Mapping[str, Files], between: str) -> Files:
    """Number participants from 1 on; the apostrophe is cleaned away, and a group stands before the name."""
    return {
        f"{'Team 1-' * (one.student_id in GROUP)}{one.name.replace(chr(39), '')}_{k}_assignsubmission_file_{between}"
        f"{name}": data
        for k, one in enumerate(CLASS, 1)
        for name, data in work[one.student_id].items()
    }


def gradescope(work: Mapping[str, Files]) -> Files:
    """Number submissions from 1 on; a group hands in once."""
    handed_in = [(one,) for one in CLASS if one.student_id not in GROUP]
    groups = [*handed_in, tuple(one for one in CLASS if one.student_id in GROUP)]
    lines, files = ["---"], Files()
    for k, group in enumerate(groups, 1):
        lines += [f"submission_{k}:", "  :submitters:"]
        lines += [f"  - :name: {one.name}\n    :sid: '{one.student_id}'\n    :email: {k}@else.edu" for one in group]
        files |= {f"submission_{k}/{name}": data for name, data in work[group[0].student_id].items()}
    return {"submission_metadata.yml": "\n".join(lines) + "\n", **files}


def folders(work: Mapping[str, Files], shape: str) -> Files:
    """Put everybody's files where `shape` says."""
    return {
        shape.format(student=student, name=name): data
        for student, files in work.items()
        for name, data in files.items()
    }


def plain(work: Mapping[str, Files]) -> Files:
    """Keep one file a student, called by the id."""
    return {
        f"{student}.{next(iter(files)).rpartition('.')[2]}": next(iter(files.values()))
        for student, files in work.items()
    }


LAYOUTS: dict[str, Callable[[Mapping[str, Files]], Files]] = {
    "gradescope": gradescope,
    "canvas": canvas,
    "moodle folders": lambda work: moodle(work, "/"),
    "moodle flat": lambda work: moodle(work, ""),
    "nbgrader": lambda work: folders(work, "submitted/{student}/ps1/{name}"),
    "a folder a student": lambda work: folders(work, "{student}/{name}"),
    "plain": plain,
}
NAMED = {"canvas", "moodle folders", "moodle flat"}  # these say no id that a ledger would know


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("roster", [True, False])
@pytest.mark.parametrize("with_ledger", [True, False])
def test_whose_each_upload_is(
    layout: str, roster: bool, with_ledger: bool, work: dict[str, Files], ledger: Ledger, tmp_path: Path
) -> None:
    """Everybody is found once, on the own variant, or nobody is: never somebody else; only staff hear of a doubt."""
    submissions = collect([write(tmp_path / "class", LAYOUTS[layout](work))])
    assert len(submissions) == len(CLASS)
    students = CLASS if roster else tuple(Student(one.student_id) for one in CLASS if with_ledger)
    assigned = assign(submissions, People(students, ledger if with_ledger else None))
    found = {one.student_id for one in assigned.values()}
    names_help = roster or layout not in NAMED
    if students and names_help:
        assert found == {one.student_id for one in CLASS}
    for one in submissions:
        mine = assigned[one.id]
        if mine.student_id is None:
            assert not (students and names_help)
            assert mine.variant.identifier == "worked-example"
            continue
        assert with_ledger <= (mine.variant.student_id == mine.student_id)
        doubt = {"s1001": "s1002", COPIED: "s1002" * with_ledger, "1": "s1005"}.get(mine.student_id, "")
        if layout == "plain":
            doubt = "s1002" * (mine.student_id == COPIED and with_ledger)
        assert (doubt in mine.flag) if doubt else not mine.flag, (mine.student_id, mine.flag)
        assert not any(other.student_id in mine.note.split() for other in CLASS if other.student_id != mine.student_id)


@pytest.mark.slow
@pytest.mark.parametrize("layout", LAYOUTS)
def test_the_same_marks_in_every_layout(
    layout: str, run: Callable[..., Ended], work: dict[str, Files], ledger: Ledger, tmp_path: Path
) -> None:
    """On the own variant all answers are right; copied ones are not, are flagged, and no page names their owner."""
    uploads = write(tmp_path / "class", LAYOUTS[layout](work))
    write_ledger(tmp_path / "variants.csv", ledger)
    rows = "".join(f'{one.student_id},"{one.name}",{one.email}\n' for one in CLASS)
    (tmp_path / "roster.csv").write_text(f"student_id,name,email\n{rows}", encoding="utf-8")
    where = ("--roster", tmp_path / "roster.csv", "--ledger", tmp_path / "variants.csv")
    code, _, err = run("grade", uploads, "-o", tmp_path / "out", *where, "--examples", 3, "--workers", 2)
    assert code == 0, err
    found = [msgspec.json.decode(path.read_bytes(), type=Result) for path in (tmp_path / "out/results").iterdir()]
    answers = {one.student_id: next(stage.score for stage in one.stages if stage.name == "answers") for one in found}
    assert {one.student_id: (one.score or 0) - answers[one.student_id] for one in found} == {
        one.student_id: 100.0 for one in CLASS
    }
    right = {one.student_id for one in CLASS} - {COPIED, "1"}  # the group's answers are those of one member
    assert {student for student, score in answers.items() if score == 5} == right
    for one in found:
        page = (tmp_path / "out/feedback" / f"{one.submission}.html").read_text("utf-8")
        strangers = {other.student_id for other in CLASS if len(other.student_id) > 1} - {one.student_id, "s1005"}
        assert not [other for other in strangers if other in page.replace("slam1d_with_s1002.py", "")]
        assert (one.student_id == COPIED) <= any("s1002" in flag for flag in one.flags)
