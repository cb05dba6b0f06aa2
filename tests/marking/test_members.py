"""Who belongs to a folder: nothing handed in is lost by forgetting an option, and nobody comes back unsaid."""

from __future__ import annotations

import shlex
from collections.abc import Callable, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import msgspec
import pytest

from autograder.commands._reporting import write_all
from autograder.commands.report import stored_results
from autograder.course import Course
from autograder.engine.store import Store
from autograder.errors import UsageError
from autograder.marking.folder import decided
from autograder.marking.marks import Mark, digest, read_marks, write_marks
from autograder.marking.members import Change, enter_members, forget, members_after, read_members
from autograder.marking.sheet import FILE, read_sheet
from tests.marking.written import TEXTS, answered
from tests.reports.examples import result


def update_members(
    out: Path, paths: Sequence[Path], names: Sequence[str], roster: Sequence[str] = (), *, some: bool = False
) -> Change:
    """Enter uploads, as a run does that nothing refuses."""
    change = members_after(out, paths, names, roster, some=some)
    enter_members(out, change)
    return change


@pytest.fixture
def graded(tmp_path: Path) -> Callable[..., tuple[str, ...]]:
    """Grade uploads by hand: enter them, store a result for each, return what is said."""
    for place in ("uploads", "late"):
        (tmp_path / place).mkdir()

    def graded(place: str, *names: str, some: bool = False) -> tuple[str, ...]:
        store = Store(tmp_path / "out")
        change = update_members(tmp_path / "out", [tmp_path / place], names, some=some)
        for name in names:
            store.save(result(name))
        return change.notes

    return graded


def _members(out: Path) -> list[str]:
    return [one.submission for one in stored_results(out)]


def test_a_removed_upload_is_kept_aside_for_every_command_and_said(
    graded: Callable[..., tuple[str, ...]], tmp_path: Path
) -> None:
    """It is in no report and no export, and it is not lost."""
    out = tmp_path / "out"
    assert graded("uploads", "ann", "bob", "cy") == ()
    (note,) = graded("uploads", "ann", "bob2")
    assert note.startswith("2 submissions were handed in before and are gone now (bob, cy): kept aside; ")
    assert "--forget" in note
    assert _members(out) == ["ann", "bob2"]
    assert (out / "results/bob.json").exists()
    (note,) = graded("uploads", "ann", "bob2", "cy")
    assert note == "1 submission was kept aside and handed in again: cy."
    assert _members(out) == ["ann", "bob2", "cy"]
    forget(out, ["bob"])
    assert not (out / "results/bob.json").exists()
    assert read_members(out).aside == ()


def test_the_command_to_type_can_be_typed(tmp_path: Path) -> None:
    """A folder may have blanks in its name."""
    out = tmp_path / "my class"
    out.mkdir()
    update_members(out, [tmp_path], ["ann", "bob"])
    (note,) = update_members(out, [tmp_path], ["ann"]).notes
    command = note.partition("`")[2].partition("`")[0]
    assert shlex.split(command) == ["autograder", "report", str(out), "--forget", "NAME"]


def test_one_late_file_joins_the_class(graded: Callable[..., tuple[str, ...]], tmp_path: Path) -> None:
    """Eighty that were read from elsewhere stay, and that is said."""
    names = [f"s{number}" for number in range(80)]
    graded("uploads", *names)
    (note,) = graded("late/zoe.py", "zoe")
    assert note.startswith("80 submissions are not in what was given now and stay (")
    assert _members(tmp_path / "out") == sorted([*names, "zoe"])
    assert not any("gone" in note for note in graded("uploads", *names))
    assert len(_members(tmp_path / "out")) == 81


def test_a_file_of_the_folder_given_by_itself_belongs_to_the_folder(
    graded: Callable[..., tuple[str, ...]], tmp_path: Path
) -> None:
    """So it is gone when the folder is given without it."""
    graded("uploads", "ann", "bob")
    graded("uploads/ann.py", "ann")
    (note,) = graded("uploads", "bob")
    assert "1 submission was handed in before and is gone now (ann)" in note
    assert _members(tmp_path / "out") == ["bob"]


def test_another_upload_of_the_same_name_is_said(graded: Callable[..., tuple[str, ...]]) -> None:
    """Two students may call their file the same; the second would take the place of the first in silence."""
    graded("uploads", "slam1d")
    assert graded("late", "slam1d") == ("1 submission comes from another place than before: slam1d.",)


def test_a_folder_of_before_there_was_a_record_loses_nobody(tmp_path: Path) -> None:
    """Who has a result belongs to it."""
    Store(tmp_path).save(result("ann"))
    change = update_members(tmp_path, [tmp_path / "uploads"], ["bob"])
    assert change.staying == ("ann",)
    assert _members(tmp_path) == ["ann"]


def test_only_what_is_there_can_be_forgotten(graded: Callable[..., tuple[str, ...]], tmp_path: Path) -> None:
    """A slip of the pen drops nobody."""
    graded("uploads", "ann")
    with pytest.raises(UsageError, match="--forget an: .* holds no submission of this name"):
        forget(tmp_path / "out", ["ann", "an"])
    assert _members(tmp_path / "out") == ["ann"]


def test_a_damaged_record_changes_nothing(tmp_path: Path) -> None:
    """It is an error with a sentence, for a guess could bring somebody back."""
    (tmp_path / "members.json").write_text("{")
    with pytest.raises(UsageError, match="cannot be read as the record"):
        read_members(tmp_path)


HEAD = "student,stage,points,reason,who,when\n"


def test_a_total_can_be_given_to_somebody_of_the_roster_who_handed_in_nothing(tmp_path: Path) -> None:
    """An oral exam counts without an upload; an id that is on no roster is still a slip of the pen."""
    update_members(tmp_path, [tmp_path], ["ann"], ["s1", "s2"])
    (tmp_path / "overrides.csv").write_text(f"{HEAD}s2,total,40,oral exam,Prof,today\n")
    found = {one.submission: one for one in decided(tmp_path, [result("ann")]).results}
    assert found["s2"].score == 40.0
    assert found["s2"].student_id == "s2"
    assert set(found) == {"ann", "s2"}
    (tmp_path / "overrides.csv").write_text(f"{HEAD}s3,total,40,oral exam,Prof,today\n")
    with pytest.raises(UsageError, match="no submission or student id 's3'"):
        decided(tmp_path, [result("ann")])


def test_two_overrides_of_one_mark_under_two_names_are_refused(tmp_path: Path) -> None:
    """The later line would win in silence."""
    (tmp_path / "overrides.csv").write_text(f"{HEAD}ann,total,40,r,Prof,today\ns1,total,50,r,Prof,today\n")
    with pytest.raises(UsageError, match="Line 3: s1 has an override of total in line 2 already, as ann"):
        decided(tmp_path, [msgspec.structs.replace(result("ann"), student_id="s1")])


def test_an_override_of_somebody_kept_aside_blocks_nothing(
    graded: Callable[..., tuple[str, ...]], tmp_path: Path
) -> None:
    """It holds again when the upload comes back."""
    out = tmp_path / "out"
    graded("uploads", "ann", "bob")
    graded("uploads", "bob")
    (out / "overrides.csv").write_text(f"{HEAD}ann,total,40,r,Prof,today\n")
    assert [one.submission for one in decided(out, stored_results(out)).results] == ["bob"]


@pytest.mark.parametrize(("key", "roster", "said"), [("Ann", (), "did you mean ann"), ("zoe", ("s1",), "the roster")])
def test_an_extension_that_fits_nobody_is_refused(tmp_path: Path, key: str, roster: tuple[str, ...], said: str) -> None:
    """The report stops; grading only says it, for the rest of the class need not wait."""
    update_members(tmp_path, [tmp_path], ["ann"], roster)
    course = Course(extensions={key: datetime(2026, 11, 20, tzinfo=UTC)})
    with pytest.raises(UsageError, match=said):
        decided(tmp_path, [result("ann")], course)
    assert key in decided(tmp_path, [result("ann")], course, strict=False).notes[0]


def test_an_extension_of_somebody_who_has_still_to_hand_in_is_a_note_without_a_roster(tmp_path: Path) -> None:
    """Nobody can tell yet; with a roster its ids are known, handed in or not."""
    course = Course(extensions={"zoe": datetime(2026, 11, 20, tzinfo=UTC)})
    assert decided(tmp_path, [result("ann")], course).notes == ("[extensions] zoe fits no submission or student id.",)
    update_members(tmp_path, [tmp_path], ["ann"], ["zoe"])
    assert decided(tmp_path, [result("ann")], course).notes == ()


def test_a_sheet_as_it_was_written_brings_no_old_marks_back(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Later marks, or other points, are no reason to ask for it; taken all the same, it changes none."""
    ann = answered("ann")
    marks = [
        Mark("ann", question, 1.0, most, "", digest(TEXTS[question])) for question, most in (("2", 2.0), ("3", 3.0))
    ]
    write_marks(tmp_path, marks)
    Store(tmp_path)
    write_all(tmp_path, [ann], {"versions": {}}, Course())
    old = (tmp_path / FILE).read_bytes()
    write_marks(tmp_path, [replace(one, points=2.0) for one in marks])
    taken = read_sheet(tmp_path / FILE, decided(tmp_path, [ann]).answers()).marks
    assert [one.points for one in taken] == [2.0, 2.0]
    write_all(tmp_path, [ann], {"versions": {}}, Course(question_points={"2": 4.0, "3": 6.0}))
    assert "not read yet" not in capsys.readouterr().err
    assert (tmp_path / FILE).read_bytes() != old
    assert [one.points for one in read_marks(tmp_path).values()] == [2.0, 2.0]


def test_points_in_a_sheet_are_out_of_the_maximum_that_stands_beside_them(tmp_path: Path) -> None:
    """Where the points of the course have doubled since, a full mark stays a full mark."""
    sheet = tmp_path / "filled.csv"
    sheet.write_text("submission,question,max_points,answer,points,comment\nann,2,2,x,2,\n")
    course = Course(points={**Course().points, "written": 10.0})
    (mark,) = read_sheet(sheet, decided(tmp_path, [answered("ann")], course).answers()).marks
    assert (mark.points, mark.of) == (2.0, 2.0)
