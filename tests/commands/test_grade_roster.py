"""Grading a released class: whose each submission is, on whose numbers it is judged, and what staff are told."""

from __future__ import annotations

import csv
import json
import shutil
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import nbformat
import pytest

from autograder.problems.secret import Secret
from tests.assignment.running import reference_functions, text_of
from tests.assignment.running import run as run_notebook
from tests.commands.released import (
    SECRET,
    TERM,
    files_of_the_course,
    ledger_of,
    letter,
    module,
    options,
    variant_of,
)

Ended = tuple[int, str, str]
QUICK = ("--examples", 5, "--workers", 1)
ITERATES = """
states = [my_start]
for _ in range(3):
    states.append(states[-1] + gauss_newton_step(states[-1], my_graph))
iterates = np.array(states)
"""


@pytest.fixture
def files(run: Callable[..., Ended], tmp_path: Path) -> dict[str, Path]:
    """Release the class; return roster and secret."""
    files = files_of_the_course(tmp_path)
    assert run("release", *options(files), "-o", tmp_path / "release")[0] == 0
    (tmp_path / "uploads").mkdir()
    return files


def results(out: Path) -> dict[str, dict[str, Any]]:
    """Read all results of a run."""
    return {path.stem: json.loads(path.read_bytes()) for path in (out / "results").glob("*.json")}


def stage(result: dict[str, Any], name: str) -> dict[str, Any]:
    """Return one stage of a result."""
    return next(each for each in result["stages"] if each["name"] == name)


def test_everybody_is_judged_on_their_own_numbers(
    run: Callable[..., Ended], files: dict[str, Path], tmp_path: Path
) -> None:
    """Matched by file name, judged on the ledger; somebody else's numbers are flagged; who is missing is listed."""
    one, two = (variant_of(tmp_path / "release", name) for name in ("s1", "s2"))
    (tmp_path / "uploads" / "hw_s1.py").write_text(module(one))
    (tmp_path / "uploads" / "hw_s2.py").write_text(module(one))
    ledger = tmp_path / "release" / "staff" / "variants.csv"
    code, _, err = run("grade", tmp_path / "uploads", "-o", tmp_path / "out", *options(files, ledger=ledger), *QUICK)
    assert code == 0
    found = results(tmp_path / "out")
    honest, copied = found["hw_s1"], found["hw_s2"]
    assert (honest["student_id"], honest["variant"], honest["flags"]) == ("s1", one.identifier, [])
    assert stage(honest, "answers")["score"] == 5
    assert honest["notes"] == ["Taken for the submission of s1, going by the file name."]
    assert honest["seed"] == Secret(SECRET.encode()).seed(TERM)
    assert (copied["student_id"], copied["variant"]) == ("s2", two.identifier)
    assert stage(copied, "answers")["score"] < 5
    assert copied["flags"] == [
        f"{where}: the numbers of s1."
        for where in ("The start x^(0)", "The answer x^(1)", "The measurements in the source")
    ]
    assert copied["score"] - stage(copied, "answers")["score"] == honest["score"] - 5
    assert "the numbers of s1" in (tmp_path / "out" / "report.html").read_text("utf-8")
    assert "numbers of s1" not in (tmp_path / "out" / "feedback" / "hw_s2.html").read_text("utf-8")
    with (tmp_path / "out" / "grades.csv").open(newline="") as file:
        assert [row["student_id"] for row in csv.DictReader(file)] == ["s1", "s2"]
    assert "No submission from 1 of 3 students: s3 (Cy Tan)." in err
    assert (tmp_path / "out" / "missing.csv").read_text() == "student_id,name,email\ns3,Cy Tan,cy@x.org\n"


def test_folder_file_name_and_metadata_count_in_this_order(
    run: Callable[..., Ended], files: dict[str, Path], graded: dict[str, Any], tmp_path: Path
) -> None:
    """A folder is believed before a file name, that before the notebook's metadata; what disagrees is flagged."""
    notebook = (tmp_path / "release" / "students" / "s2" / "slam1d.ipynb").read_text("utf-8")
    for place in ("s1/slam1d.ipynb", "x/slam1d.ipynb", "y/s3.ipynb"):
        (tmp_path / "uploads" / place).parent.mkdir()
        (tmp_path / "uploads" / place).write_text(notebook, encoding="utf-8")
    ledger = tmp_path / "release" / "staff" / "variants.csv"
    assert run("grade", tmp_path / "uploads", "-o", tmp_path / "out", *options(files, ledger=ledger))[0] == 0
    said = {name: (one.student_id, one.note, one.flag) for name, one in graded["assigned"].items()}
    words = "Whose submission this is was told by the {}."  # where there is doubt, a page names nobody
    assert said == {
        "s1": ("s1", words.format("folder"), "The notebook metadata name s2."),
        "x": ("s2", "Taken for the submission of s2, going by the notebook metadata.", ""),
        "y": ("s3", words.format("file name"), "The notebook metadata name s2."),
    }
    assert all(one.variant.student_id == one.student_id for one in graded["assigned"].values())
    assert graded["settings"].seed == Secret(SECRET.encode()).seed(TERM)


def test_without_a_ledger_the_variants_are_drawn_again(
    run: Callable[..., Ended], files: dict[str, Path], graded: dict[str, Any], tmp_path: Path
) -> None:
    """Roster, term and secret give everybody the numbers of the release; a seed that is given holds."""
    for name in ("s1", "s2", "s3"):
        (tmp_path / "uploads" / f"{name}.py").write_text("x = 1\n")
    _, _, err = run("grade", tmp_path / "uploads", "-o", tmp_path / "out", *options(files), "--seed", 7)
    for name in ("s1", "s2", "s3"):
        assert graded["assigned"][name].variant.exact == variant_of(tmp_path / "release", name).exact
    assert graded["settings"].seed == 7
    assert "No submission" not in err


def test_a_roster_alone_says_whose_each_is(
    run: Callable[..., Ended], files: dict[str, Path], graded: dict[str, Any], tmp_path: Path
) -> None:
    """Without variants everybody has the worked example; whose a submission is not is said, and the seed stays 0."""
    (tmp_path / "uploads" / "Ann Lee.py").write_text("x = 1\n")
    (tmp_path / "uploads" / "a stranger.py").write_text("x = 2\n")
    _, _, err = run("grade", tmp_path / "uploads", "-o", tmp_path / "out", "--roster", files["--roster"])
    people = {one.student_id: one for one in graded["assigned"].values()}
    assert set(people) == {"s1", None}
    assert people["s1"].variant.identifier == "worked-example"
    assert people["s1"].others is None
    assert people[None].note == "It was not clear whose submission this is."
    assert "1 submission is nobody's of the class: a stranger; say whose with --is 'a stranger=ID'." in err
    assert graded["settings"].seed == 0


def test_word_of_the_staff_is_remembered(
    run: Callable[..., Ended], files: dict[str, Path], graded: dict[str, Any], tmp_path: Path
) -> None:
    """What --is says holds in later runs until it is taken back; a slip in it is refused, and changes nothing."""
    (tmp_path / "uploads" / "Plato_17_assignsubmission_file_slam1d.py").write_text("x = 1\n")
    command = ("grade", tmp_path / "uploads", "-o", tmp_path / "out", "--roster", files["--roster"])

    def whose(*more: object) -> tuple[str | None, str]:
        assert run(*command, *more)[0] == 0
        (one,) = graded["assigned"].values()
        return one.student_id, one.by

    assert whose() == (None, "")
    assert whose("--is", "Plato_17=S2") == ("s2", "word of the course staff")
    assert (tmp_path / "out" / "owners.csv").read_text() == "submission,student_id\nPlato_17,s2\n"
    assert whose() == ("s2", "word of the course staff")
    for wrong, words in {"Plato_17=s22": "nobody with the id 's22'", "Plato=s2": "no submission 'Plato'"}.items():
        code, _, err = run(*command, "--is", wrong)
        assert (code, words in err, err.count("\n")) == (2, True, 1)
    assert whose("--is", "Plato_17=") == (None, "")
    assert whose() == (None, "")


def test_a_number_of_the_platform_is_nobodys_id_where_nobody_is_known(
    run: Callable[..., Ended], files: dict[str, Path], graded: dict[str, Any], tmp_path: Path
) -> None:
    """A participant who is not of the roster does not get the id of somebody who is; another roster is said."""
    files["--roster"].write_text("student_id,name\n17,Kim Law\n")
    (tmp_path / "uploads" / "Plato_17_assignsubmission_file_slam1d.py").write_text("x = 1\n")
    _, _, err = run("grade", tmp_path / "uploads", "-o", tmp_path / "out", "--roster", files["--roster"])
    (one,) = graded["assigned"].values()
    assert (one.student_id, one.free, one.account) == (None, False, "Moodle 17")
    assert "is it the roster of this class?" in err


def test_a_student_without_a_variant_is_flagged(
    run: Callable[..., Ended], files: dict[str, Path], graded: dict[str, Any], tmp_path: Path
) -> None:
    """Who joined after the release is judged on the worked example, and staff are told; so is a second submission."""
    with files["--roster"].open("a") as file:
        file.write("s4,Di Oak,di@x.org,2\n")
    for name in ("s4.py", "s1 first.py", "s1 second.py"):
        (tmp_path / "uploads" / name).write_text(f"x = {name!r}\n")
    ledger = tmp_path / "release" / "staff" / "variants.csv"
    run("grade", tmp_path / "uploads", "-o", tmp_path / "out", *options(files, ledger=ledger))
    late = graded["assigned"]["s4"]
    assert late.flag == "s4 has no variant on record."
    assert late.note.endswith("; the answers were judged on the worked example.")
    assert [one.flag for one in graded["assigned"].values() if one.student_id == "s1"] == [
        "s1 has 2 submissions (s1 first, s1 second): take away what does not count, and grade again."
    ] * 2


def test_a_term_without_its_secret_is_refused(
    run: Callable[..., Ended], files: dict[str, Path], tmp_path: Path
) -> None:
    """Term and secret go together; nothing is graded with half of them."""
    (tmp_path / "uploads" / "s1.py").write_text("x = 1\n")
    code, _, err = run("grade", tmp_path / "uploads", "-o", tmp_path / "out", "--term", TERM)
    assert (code, err.count("\n")) == (2, 1)
    assert "--secret-file is missing" in err


@pytest.mark.slow
def test_the_keys_of_every_family_get_full_marks(run: Callable[..., Ended], tmp_path: Path) -> None:
    """The worked notebooks of a release, handed in by the students they belong to, earn everything but the words."""
    files = files_of_the_course(tmp_path)
    students = [f"s{number:02}" for number in range(14)]
    files["--roster"].write_text("student_id\n" + "\n".join(students) + "\n")
    families = [word for letter in "EWABCDL" for word in ("--family", letter)]
    assert run("release", *options(files), "-o", tmp_path / "release", *families)[0] == 0
    staff = tmp_path / "release" / "staff"
    assert len({variant.family for variant in ledger_of(tmp_path / "release")}) > 3
    code, _, err = run(
        "grade", staff / "worked", "-o", tmp_path / "out", *options(files, ledger=staff / "variants.csv"), *QUICK
    )
    found = results(tmp_path / "out")
    assert (code, sorted(found)) == (0, students)
    assert {(one["student_id"] == name, one["score"], tuple(one["flags"])) for name, one in found.items()} == {
        (True, 105, ())
    }
    assert "No submission" not in err


@pytest.mark.slow
def test_a_released_folder_as_a_student_would_use_it(
    run: Callable[..., Ended], files: dict[str, Path], tmp_path: Path
) -> None:
    """Opened, solved, self-checked in the notebook, zipped as a whole, graded: full marks but for the written part."""
    variant = variant_of(tmp_path / "release", "s3")
    folder = tmp_path / "desk" / "s3"
    with zipfile.ZipFile(tmp_path / "release" / "zips" / "s3.zip") as archive:
        archive.extractall(tmp_path / "desk")
    solved = _solve(folder, letter(variant))
    checks = [cell.id for cell in solved.cells if cell.id.startswith("check")]
    lines = "".join(text_of(solved, name) for name in checks).splitlines()
    assert len([line for line in lines if line.startswith("PASS")]) > 20
    assert not [line for line in lines if line.startswith(("FAIL", "TODO"))]
    shutil.make_archive(str(tmp_path / "uploads" / "anything s3"), "zip", tmp_path / "desk")
    ledger = tmp_path / "release" / "staff" / "variants.csv"
    code, _, _ = run("grade", tmp_path / "uploads", "-o", tmp_path / "out", *options(files, ledger=ledger), *QUICK)
    (result,) = results(tmp_path / "out").values()
    assert code == 0
    assert (result["score"], result["awaiting"], result["max_score"]) == (95, 5, 100)
    assert (result["student_id"], result["variant"], result["flags"]) == ("s3", variant.identifier, [])
    assert result["written"] == {"2": "The second step is zero.", "3": "f is affine."}


def _solve(folder: Path, conclusion: str) -> Any:
    """Work through the notebook of a folder and save it there."""
    notebook = nbformat.read(folder / "slam1d.ipynb", as_version=4)  # type: ignore[no-untyped-call]  # nbformat has no types
    cells = {cell.id: cell for cell in notebook.cells}
    cells["iterates"].source = ITERATES
    cells["conclusion"].source = f"conclusion = {conclusion!r}"
    cells["answer-2"].source += "\n\nThe second step is zero."
    cells["answer-3"].source += "\n\nf is affine."
    ran, stopped = run_notebook(notebook, reference_functions(), folder)
    assert stopped is None
    nbformat.write(ran, folder / "slam1d.ipynb")
    return ran
