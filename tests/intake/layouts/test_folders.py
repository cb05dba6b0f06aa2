"""Plain folders, folders a student and repositories: whose file it is follows from where it lies."""

from __future__ import annotations

from pathlib import Path

import pytest

from autograder.errors import UsageError
from autograder.intake import layouts as package
from autograder.intake.layouts import detect, layouts, named
from autograder.intake.submission import Submission, collect
from autograder.intake.tree import Tree
from tests.intake.making import CODE, archive, cell, notebook, write


def by_id(path: Path, layout: str | None = None) -> dict[str, Submission]:
    """Collect, by id."""
    return {each.id: each for each in collect([path], layout)}


def layouts_of(found: dict[str, Submission]) -> set[str]:
    """Return the layouts that were seen."""
    return {each.layout for each in found.values()}


def test_every_file_of_the_package_is_a_layout() -> None:
    """A new layout is one new file; nothing else lists them."""
    here = {path.stem for path in Path(package.__file__).parent.glob("[!_]*.py")}
    assert {layout.name for layout in layouts()} == here
    assert {"plain", "folder_a_student", "canvas", "moodle", "gradescope", "nbgrader", "repositories"} <= here
    assert all(layout.title for layout in layouts())
    assert all(layout.recognise(Tree("empty", ())) == 0 for layout in layouts())
    assert detect(Tree("empty", ()))[0].name == "plain"


def test_a_layout_that_does_not_exist_is_said() -> None:
    """The names that exist are given, or the one that was meant."""
    with pytest.raises(UsageError, match="There is no layout 'canvass'; did you mean canvas\\?"):
        named("canvass")
    with pytest.raises(UsageError, match="known are canvas, folder_a_student, gradescope"):
        collect([Path()], "zzz")


def test_a_folder_a_student_names_the_submission(tmp_path: Path) -> None:
    """Whatever the file is called, and however deep it lies below the student's folder."""
    write(tmp_path, {"alice/slam1d.py": CODE, "bob/work/hw.py": CODE, "carol/x.zip": archive({"slam1d.py": CODE})})
    found = by_id(tmp_path)
    assert list(found) == ["alice", "bob", "carol"]
    assert layouts_of(found) == {"folder_a_student"}
    assert found["bob"].path.endswith("/bob/work/hw.py")


def test_a_student_without_a_submission_is_not_lost(tmp_path: Path) -> None:
    """Empty folders, foreign files and several files each have their sentence."""
    write(
        tmp_path,
        {
            "alice/slam1d.py": CODE,
            "bob/report.pdf": "",
            "carol/one.py": CODE,
            "carol/two.py": CODE,
            "dave/slam1d.py": CODE,
            "dave/extra.py": CODE,
            "frank/posegraph.py": "",
            "notes.txt": "",
        },
    )
    (tmp_path / "erin").mkdir()
    (tmp_path / ".git").mkdir()
    found = by_id(tmp_path)
    expected = "expected one .py, .ipynb or .zip file"
    assert {name: each.rejection for name, each in found.items()} == {
        "alice": "",
        "bob": f"bob holds no submission (found report.pdf), {expected}.",
        "carol": f"carol holds 2 submissions (one.py, two.py), {expected}; keep the one that counts.",
        "dave": f"dave holds 2 submissions (extra.py, slam1d.py), {expected}; keep the one that counts.",
        "erin": f"erin holds no submission (found nothing), {expected}.",
        "frank": f"frank holds only files that were handed out (posegraph.py), {expected}.",
    }


@pytest.mark.parametrize("other", ["utils.py", "slam1d.ipynb", "explore.ipynb", "old.py"])
def test_of_several_files_what_was_begun_counts(tmp_path: Path, other: str) -> None:
    """Whatever it is called, and whatever was handed out beside it; the rest is named."""
    beside = {
        "utils.py": "import numpy as np\n",
        "slam1d.ipynb": Path("assignment/slam1d.ipynb").read_text(),
        "explore.ipynb": Path("assignment/explore.ipynb").read_text(),
        "old.py": "notes = 1\n",
    }
    write(tmp_path, {"dave/homework3.py": CODE, f"dave/{other}": beside[other], "erin/slam1d.py": CODE})
    found = by_id(tmp_path, "folder_a_student")
    assert found["dave"].source is not None
    assert found["dave"].source.name == "homework3.py"
    assert found["dave"].notes == (f"Graded homework3.py; also handed in and not graded: {other}.",)


def test_a_plain_folder_names_submissions_by_their_stem(tmp_path: Path) -> None:
    """Also in sections; only the homework's own name gives way to the folder's."""
    write(tmp_path, {"alice.py": CODE, "late/carol.py": CODE, "late/dave.py": CODE, "erin/slam1d.py": CODE})
    found = by_id(tmp_path)
    assert list(found) == ["alice", "carol", "dave", "erin"]
    assert layouts_of(found) == {"plain"}
    write(tmp_path / "two", {"monday/alice.py": CODE, "monday/x.py": CODE, "friday/alice.py": CODE, "friday/y.py": ""})
    assert list(by_id(tmp_path / "two")) == ["friday-alice", "monday-alice", "x", "y"]


def test_a_page_beside_the_notebook_of_the_same_name_goes_with_it(tmp_path: Path) -> None:
    """One student keeps one row, and the row says what else was there; a second notebook is a row of its own."""
    files = {"jane.ipynb": notebook(cell()), "jane.html": "<html></html>", "jane.md": "# Notes", "bob.html": "<html>"}
    found = by_id(write(tmp_path, files))
    assert {name: bool(each.rejection) for name, each in found.items()} == {"jane": False, "bob": True}
    assert found["jane"].notes[0] == "Graded jane.ipynb; also handed in and not graded: jane.html, jane.md."
    two = by_id(write(tmp_path, {"jane.py.txt": CODE}))
    assert sum(not each.rejection for each in two.values()) == 2


def test_of_two_files_of_one_name_what_was_begun_counts(tmp_path: Path) -> None:
    """As in every other layout: the untouched notebook beside a solved module is no submission of its own."""
    handed_out = (Path(__file__).parents[3] / "assignment/slam1d.ipynb").read_bytes()
    found = by_id(write(tmp_path, {"jane.py": CODE, "jane.ipynb": handed_out, "bob.ipynb": handed_out}))
    assert list(found) == ["bob", "jane"]
    assert found["jane"].path.endswith("jane.py")
    assert found["jane"].notes == ("Graded jane.py; also handed in and not graded: jane.ipynb.",)
    both = by_id(write(tmp_path, {"jane.ipynb": notebook(cell())}))
    assert list(both) == ["bob", "jane", "jane-2"]


def test_files_and_folders_of_students_may_stand_side_by_side(tmp_path: Path) -> None:
    """A folder with one submission in it names it; a folder of something else is nobody's."""
    write(tmp_path, {"alice.py": CODE, "bob.ipynb": "", "carol/hw.py": CODE, "figures/x.png": "", "dave/x.py": CODE})
    write(tmp_path, {"erin.json": notebook(cell()), "frank.pdf": "%PDF"})
    found = by_id(tmp_path)
    assert [name for name, each in found.items() if not each.rejection] == ["alice", "carol", "dave", "erin"]
    assert list(found) == ["alice", "bob", "carol", "dave", "erin", "frank"]
    assert layouts_of(found) == {"folder_a_student"}
    assert list(by_id(tmp_path, "plain")) == ["alice", "bob", "erin", "frank", "hw", "x"]


def test_folders_given_one_by_one_name_their_submission(tmp_path: Path) -> None:
    """`grade class/*/` and `grade class` find the same students."""
    write(tmp_path, {"alice/slam1d.py": CODE, "bob/slam1d.py": CODE})
    assert [each.id for each in collect([tmp_path / "alice", tmp_path / "bob"])] == ["alice", "bob"]
    assert list(by_id(tmp_path)) == ["alice", "bob"]


def test_a_wrapping_folder_is_looked_through(tmp_path: Path) -> None:
    """The folder that an archive unpacks into names nobody."""
    write(tmp_path, {"hw1/alice/hw.py": CODE, "hw1/bob/hw.py": CODE})
    assert list(by_id(tmp_path)) == ["alice", "bob"]


def test_a_layout_can_be_overridden(tmp_path: Path) -> None:
    """What is detected is a guess, and the user knows better."""
    write(tmp_path, {"alice/one.py": CODE, "bob/two.py": CODE})
    assert list(by_id(tmp_path, "plain")) == ["one", "two"]
    assert layouts_of(by_id(tmp_path, "plain")) == {"plain"}
    path = write(tmp_path, {"class.zip": archive({"alice.py": CODE, "bob.py": CODE})}) / "class.zip"
    assert "an archive of a whole class is unpacked first" in by_id(path)["class"].rejection
    assert list(by_id(path, "plain")) == ["alice", "bob"]


def test_an_archive_given_by_itself_is_one_submission(tmp_path: Path) -> None:
    """It is called by its own name, whatever is called how in it."""
    write(tmp_path, {"alice.zip": archive({"hw/slam1d.py": CODE}), "bob.zip": b"", "class/alice.zip": b"PK"})
    assert by_id(tmp_path / "alice.zip")["alice"].layout == "file"
    write(tmp_path, {"carol.zip": archive({"slam-carol/slam1d.py": CODE, "slam-carol/.git/config": ""})})
    assert by_id(tmp_path / "carol.zip")["carol"].source is not None
    assert by_id(tmp_path / "bob.zip")["bob"].rejection.startswith("bob.zip is no zip archive")


def test_repositories_are_named_by_their_user(tmp_path: Path) -> None:
    """What all folders share before a dash is the assignment; tests in a repository are not handed in."""
    for user, name in [("ada", "slam1d.py"), ("alan", "hw.ipynb.py"), ("grace-h", "src/slam1d.py")]:
        write(
            tmp_path,
            {
                f"slam-1d-{user}/{name}": CODE,
                f"slam-1d-{user}/.git/config": "",
                f"slam-1d-{user}/tests/test_it.py": CODE,
                f"slam-1d-{user}/tests/grader.py": CODE,
                f"slam-1d-{user}/posegraph.py": "",
            },
        )
    write(tmp_path, {"slam-1d-lazy/.git/config": "", "slam-1d-lazy/README.md": ""})
    found = by_id(tmp_path)
    assert list(found) == ["ada", "alan", "grace-h", "lazy"]
    assert layouts_of(found) == {"repositories"}
    assert [each.student_id for each in found.values()] == ["ada", "alan", "grace-h", "lazy"]
    assert [name for name, each in found.items() if each.rejection] == ["lazy"]
