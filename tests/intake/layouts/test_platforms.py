"""Exports of Canvas, Moodle, Gradescope and nbgrader: recognised by their marks, from folders and from archives."""

from __future__ import annotations

from pathlib import Path

import pytest

from autograder.intake.layouts.gradescope import read_metadata
from autograder.intake.submission import Submission, collect
from tests.intake.making import CODE, archive, cell, notebook, write

CANVAS = {
    "doejane_1001_55_slam1d.py": CODE,
    "doejane_1001_90_slam1d-1.py": CODE + "# second\n",
    "roejohn_LATE_1002_56_my_1_2_homework.ipynb": notebook(cell()),
    "smithann_1003_57_upload.zip": archive({"slam1d.py": CODE}),
    "smithann_1004_58_slam1d.py": CODE,
    "smithann_1004_59_notes.pdf": b"%PDF",
    "textonly_1005_text.html": "<p>see mail</p>",
    "zoëq_1006_60_posegraph.py": "",
    "anon_aB3dE_61_slam1d.py": CODE,
    "LATE_anon_Zz9_62_slam1d.py": CODE,
}
MOODLE = {
    "Jane Doe_301_assignsubmission_file/slam1d.py": CODE,
    "Jane Doe_302_assignsubmission_file_/work.ipynb": notebook(cell()),
    "Ann_Smith_303_assignsubmission_file/report.pdf": b"",
    "Joe Roe_304_assignsubmission_onlinetext/onlinetext.html": "",
    "Li Wei_305_assignsubmission_file_slam1d.py": CODE,
    "Joe Roe_304_assignsubmission_file/a.py": CODE,
}
METADATA = r"""---
submission_11:
  :submitters:
  - :name: Jane Doe
    :sid: '0042'
    :email: jane@example.org
  - :name: "Zo\xEB \"Z\" O'Neil"
    :sid:
    :email: zoe@example.org
  :created_at: 2026-02-03 04:05:06.123456000 Z
  :score: 3.0
  :results:
    tests:
    - name: 'x'
      output: |
        submission_99:
          :submitters:
          - :name: Mallory
    :submitters:
    - :name: Mallory
  :history:
  - :id: 8
    :created_at: 2026-02-01 00:00:00 Z
    :results:
      tests:
      - name: y
  - :id: 9
    :created_at: 2026-02-02 00:00:00 Z
submission_12:
  :created_at: 2026-02-03 05:00:00 Z
  :submitters:
    - :name: 'Bob ''B'''
      :sid: '7'
submission_13:
  :submitters:
  - :name: Bob 'B'
    :sid: '7'
  :created_at: 2026-02-04 05:00:00 Z
submission_14:
  :submitters:
  - :name: Gone
    :sid: '9'
"""
GRADESCOPE = {
    "submission_metadata.yml": METADATA,
    "submission_11/slam1d.py": CODE,
    "submission_12/slam1d.py": CODE,
    "submission_13/slam1d.py": CODE + "# newer\n",
    "submission_15/slam1d.py": CODE,
    "__MACOSX/submission_11/._slam1d.py": "",
}
NBGRADER = {
    "submitted/alice/ps1/slam1d.ipynb": notebook(cell()),
    "submitted/alice/ps1/timestamp.txt": "2026-02-02 14:58:23.948203 America/Los_Angeles\n",
    "submitted/bob/ps1/slam1d.ipynb": notebook(cell()),
    "submitted/bob/ps1/data.csv": "",
    "submitted/carol/ps1/timestamp.txt": "2026-02-02 14:58:23.948203 UTC",
    "source/ps1/slam1d.ipynb": notebook(cell()),
    "release/ps1/slam1d.ipynb": notebook(cell()),
}


def both_ways(folder: Path, files: dict[str, str | bytes]) -> dict[str, Submission]:
    """Collect the files from a folder and from an archive; both must give the same."""
    write(folder / "export", files)
    write(
        folder, {"export.zip": archive(files), "wrapped.zip": archive({f"top/{name}": f for name, f in files.items()})}
    )
    unpacked = collect([folder / "export"])
    for name in ("export.zip", "wrapped.zip"):
        packed = collect([folder / name])
        assert [
            (e.id, e.digest, e.rejection, e.notes, e.student_id, e.late, e.layout, e.submitted) for e in packed
        ] == [(e.id, e.digest, e.rejection, e.notes, e.student_id, e.late, e.layout, e.submitted) for e in unpacked]
    return {each.id: each for each in unpacked}


def test_canvas_takes_the_newest_attempt_of_each_user(tmp_path: Path) -> None:
    """Users with the same name are two, late is kept, and the choice is said."""
    found = both_ways(tmp_path, CANVAS)
    assert {name: (each.student_id, each.late) for name, each in found.items()} == {
        "anon_Zz9": ("Zz9", True),
        "anon_aB3dE": ("aB3dE", False),
        "doejane_1001": ("1001", False),
        "roejohn_1002": ("1002", True),
        "smithann_1003": ("1003", False),
        "smithann_1004": ("1004", False),
        "textonly_1005": ("1005", None),
        "zoëq_1006": ("1006", False),
    }
    assert {each.layout for each in found.values()} == {"canvas"}
    assert found["doejane_1001"].notes == ("Graded slam1d-1.py, the newest; handed in before: slam1d.py.",)
    assert found["doejane_1001"].source is not None
    assert found["doejane_1001"].source.cells == [CODE + "# second\n"]
    assert [name for name, each in found.items() if each.rejection] == ["textonly_1005", "zoëq_1006"]
    assert "is a text or a link typed into Canvas, expected one" in found["textonly_1005"].rejection
    assert "handed out" in found["zoëq_1006"].rejection


def test_the_first_mark_of_a_name_is_the_platforms(tmp_path: Path) -> None:
    """What looks like another person further on is the student's own name of the file; a test account is said."""
    moodle = {"Ann Lee_42_assignsubmission_file_Bob Ray_7_assignsubmission_file_slam1d.py": CODE}
    canvas = {"doejane_101_9001_roejohn_102_9002_slam1d.py": CODE, "studenttest_103_9003_slam1d.py": CODE}
    found = {**both_ways(tmp_path / "m", moodle), **both_ways(tmp_path / "c", canvas)}
    assert {name: each.student_id for name, each in found.items()} == {
        "Ann Lee_42": "42",
        "doejane_101": "101",
        "studenttest_103": "103",
    }
    assert found["doejane_101"].file == "roejohn_102_9002_slam1d.py"
    nobody = {name for name, each in found.items() if each.owner is not None and each.owner.nobody}
    assert nobody == {"studenttest_103"}


def test_a_foreign_file_among_those_of_canvas_is_not_lost(tmp_path: Path) -> None:
    """Nobody is guessed to be its owner."""
    files = {f"student{k}_{k}_{k}_slam1d.py": CODE for k in range(1, 12)}
    found = both_ways(tmp_path, {**files, "stray.py": CODE})
    assert len(found) == 12
    assert "whose it is cannot be told" in found["stray"].rejection


@pytest.mark.parametrize(
    ("files", "stray"),
    [
        (MOODLE, "Unknown/stray.py"),
        (GRADESCOPE, "other/stray.py"),
        (GRADESCOPE, "stray.py"),
        (NBGRADER, "submitted/alice/stray.ipynb"),
    ],
)
def test_a_file_that_lies_elsewhere_is_not_lost(tmp_path: Path, files: dict[str, str | bytes], stray: str) -> None:
    """It is rejected by name, and everybody else is as before."""
    found = both_ways(tmp_path, {**files, stray: CODE})
    assert "lies where this layout has no submissions" in found["stray"].rejection
    write(tmp_path / "before", files)
    assert found.keys() - {"stray"} == {each.id for each in collect([tmp_path / "before"])}


def test_moodle_takes_a_submission_a_participant(tmp_path: Path) -> None:
    """Folders, flat files and typed texts are joined by the id of the participant."""
    found = both_ways(tmp_path, MOODLE)
    assert {name: each.student_id for name, each in found.items()} == {
        "Ann_Smith_303": "303",
        "Jane Doe_301": "301",
        "Jane Doe_302": "302",
        "Joe Roe_304": "304",
        "Li Wei_305": "305",
    }
    assert {each.layout for each in found.values()} == {"moodle"}
    assert [name for name, each in found.items() if each.rejection] == ["Ann_Smith_303"]


def test_gradescope_counts_a_group_for_every_member(tmp_path: Path) -> None:
    """The newest attempt counts, and nobody in the metadata or in the folders is lost."""
    found = both_ways(tmp_path, GRADESCOPE)
    zoe = "Zoë _Z_ O_Neil_zoe@example.org"
    assert {name: each.student_id for name, each in found.items()} == {
        "Bob _B__7": "7",
        "Gone_9": "9",
        "Jane Doe_0042": "0042",
        zoe: "zoe@example.org",
        "submission_15": None,
    }
    group = "Handed in by a group of 2; it counts for every member."
    assert found["Jane Doe_0042"].digest == found[zoe].digest
    assert found["Jane Doe_0042"].notes == (group, "The newest of 3 attempts.")
    assert found["Jane Doe_0042"].submitted == "2026-02-03 04:05:06.123456000 Z"
    assert found["Bob _B__7"].source is not None
    assert found["Bob _B__7"].source.cells == [CODE + "# newer\n"]
    assert "Graded submission_13, the newest; also handed in: submission_12." in found["Bob _B__7"].notes
    assert "is listed in submission_metadata.yml, but its folder is not there" in found["Gone_9"].rejection
    assert not any("Mallory" in name for name in found)


def test_the_notes_of_a_group_name_no_other_student(tmp_path: Path) -> None:
    """A note may be shown to one member."""
    found = both_ways(tmp_path, GRADESCOPE)
    assert not any("Jane" in note for name, each in found.items() if "Jane" not in name for note in each.notes)


@pytest.mark.parametrize("metadata", [b"\xff\xfe", b"", b"just: text\n", b"- - - [\n:::"])
def test_broken_metadata_of_gradescope_lose_nobody(tmp_path: Path, metadata: bytes) -> None:
    """Submissions are then called by their folders."""
    found = both_ways(tmp_path, {"submission_metadata.yml": metadata, "submission_11/a.py": CODE})
    assert found["submission_11"].source is not None


def test_metadata_are_read_by_their_indentation() -> None:
    """What stands deeper, in results or in texts, is not taken for a student."""
    records = read_metadata(METADATA)
    assert list(records) == ["submission_11", "submission_12", "submission_13", "submission_14"]
    assert [person["name"] for person in records["submission_11"].submitters] == ["Jane Doe", 'Zoë "Z" O\'Neil']
    assert records["submission_11"].earlier == 2
    assert records["submission_12"].submitters == [{"name": "Bob 'B'", "sid": "7"}]


def test_nbgrader_takes_the_submitted_step_only(tmp_path: Path) -> None:
    """Source and release are the teacher's; a student without a notebook is reported."""
    found = both_ways(tmp_path, NBGRADER)
    assert list(found) == ["alice", "bob", "carol"]
    assert {each.layout for each in found.values()} == {"nbgrader"}
    assert found["alice"].student_id == "alice"
    assert found["alice"].submitted == "2026-02-02 14:58:23.948203 America/Los_Angeles"
    assert (
        found["carol"].rejection == "carol holds no submission (found nothing), expected one .py, .ipynb or .zip file."
    )
    submitted = collect([tmp_path / "export" / "submitted"])
    assert [each.id for each in submitted] == ["alice", "bob", "carol"]


def test_several_assignments_of_nbgrader_are_told_apart(tmp_path: Path) -> None:
    """No assignment is guessed to be the one that is meant."""
    files = {f"submitted/{student}/{ps}/hw.ipynb": notebook(cell()) for student in ("a", "b") for ps in ("ps1", "ps2")}
    assert list(both_ways(tmp_path, files)) == ["a-ps1", "a-ps2", "b-ps1", "b-ps2"]
