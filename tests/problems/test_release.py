"""Releases: everything for every student, nothing of the staff's in a student's hands, and safe to run again."""

from __future__ import annotations

import csv
import json
import zipfile
from fractions import Fraction
from pathlib import Path

import pytest

from autograder.errors import UsageError
from autograder.problems.exact import decimal
from autograder.problems.ledger import read_ledger
from autograder.problems.problem import Problem
from autograder.problems.release import LEDGER, Released, release
from autograder.problems.roster import Student
from autograder.problems.secret import Secret
from autograder.problems.variants import Variant
from autograder.render.handout import render_folder

SECRET = Secret(b"0123456789abcdef")
OTHER = Secret(b"another secret of a course")
CLASS = [Student("s3", "Cy"), Student("s1", "Ann"), Student("Zoë Müller", "Zoë")]
MIX = {"A": 1, "C": 1}


def files_of(problem: Problem) -> dict[str, str]:
    """Render a small folder: the data in their place, and a picture in a folder below."""
    data = f"variant = {problem.variant!r}\nu = {problem.graph.measurements.tolist()}\nx0 = {problem.start.tolist()}\n"
    return {"slam1d.py": data, "figures/graph.svg": "<svg/>"}


def run(out: Path, students: list[Student] | None = None, **changes: object) -> Released:
    """Release a class with the small folder."""
    settings = {"secret": SECRET, "term": "2026S", "mix": MIX, "render": files_of} | changes
    return release(students or CLASS, out=out, **settings)  # type: ignore[arg-type]  # wrong on purpose


def snapshot(folder: Path) -> dict[str, tuple[bytes, int]]:
    """Read every file below a folder, with its time of change."""
    return {
        path.relative_to(folder).as_posix(): (path.read_bytes(), path.stat().st_mtime_ns)
        for path in folder.rglob("*")
        if path.is_file()
    }


def test_a_release_has_a_folder_and_a_zip_a_student(tmp_path: Path) -> None:
    """Every student has a folder and a zip of the same files; staff have ledger, keys and solutions."""
    seen: list[tuple[int, int, str]] = []
    done = run(tmp_path, on_progress=lambda *where: seen.append(where))
    assert seen == [(1, 3, "s3"), (2, 3, "s1"), (3, 3, "Zoë Müller")]
    assert done.text() == "3 new, 0 unchanged, 0 rewritten."
    assert {path.name for path in tmp_path.iterdir()} == {"students", "zips", "staff"}
    ledger = read_ledger(tmp_path / LEDGER)
    for variant in ledger:
        folder = tmp_path / "students" / variant.student_id
        files = {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}
        assert files == {"slam1d.py", "figures/graph.svg"}
        assert variant.identifier in (folder / "slam1d.py").read_text("utf-8")
        with zipfile.ZipFile(tmp_path / "zips" / f"{variant.student_id}.zip") as archive:
            for name in files:
                assert archive.read(f"{variant.student_id}/{name}") == (folder / name).read_bytes()
            assert len(archive.namelist()) == len(files)
        page = (tmp_path / "staff" / "solutions" / f"{variant.student_id}.md").read_text("utf-8")
        assert variant.identifier in page
    with (tmp_path / "staff" / "keys.csv").open(encoding="utf-8", newline="") as file:
        keys = list(csv.DictReader(file))
    assert [row["student_id"] for row in keys] == sorted(student.student_id for student in CLASS)
    assert [tuple(map(Fraction, row["x1"].split())) for row in keys] == [variant.x1 for variant in ledger]


def test_running_it_again_changes_nothing(tmp_path: Path) -> None:
    """A second run writes no byte, whatever the order of the roster."""
    run(tmp_path)
    before = snapshot(tmp_path)
    assert run(tmp_path, CLASS[::-1]).text() == "0 new, 3 unchanged, 0 rewritten."
    assert snapshot(tmp_path) == before


def test_two_places_get_the_same_release(tmp_path: Path) -> None:
    """The same inputs give the same bytes, zips included, in one process and in several."""
    run(tmp_path / "one")
    run(tmp_path / "two", workers=2)
    one, two = snapshot(tmp_path / "one"), snapshot(tmp_path / "two")
    assert {name: data for name, (data, _) in one.items()} == {name: data for name, (data, _) in two.items()}


def test_several_processes_release_a_larger_class(tmp_path: Path) -> None:
    """With enough students the folders are written by other processes, and reported in order."""
    students = [Student(f"s{k:02}") for k in range(21)]
    done = run(tmp_path, students, workers=2)
    assert done.new == tuple(student.student_id for student in students)
    assert len(list((tmp_path / "zips").iterdir())) == 21


def test_a_new_student_adds_one_folder(tmp_path: Path) -> None:
    """One more line of the roster is one more folder; nobody else's file changes."""
    run(tmp_path)
    before = snapshot(tmp_path)
    done = run(tmp_path, [Student("a0"), *CLASS])
    assert (done.new, done.unchanged) == (("a0",), tuple(student.student_id for student in CLASS))
    after = snapshot(tmp_path)
    changed = {name for name in after if after[name] != before.get(name)}
    assert changed == {
        "students/a0/slam1d.py",
        "students/a0/figures/graph.svg",
        "zips/a0.zip",
        "staff/solutions/a0.md",
        "staff/variants.csv",
        "staff/keys.csv",
    }


def test_who_left_keeps_everything(tmp_path: Path) -> None:
    """A student who is no longer on the roster stays in ledger and folders, and is named."""
    run(tmp_path)
    before = snapshot(tmp_path)
    done = run(tmp_path, CLASS[:1])
    assert done.gone == ("Zoë Müller", "s1")
    assert "2 earlier students are not on the roster (Zoë Müller, s1); theirs stay." in done.text()
    assert snapshot(tmp_path) == before


@pytest.mark.parametrize("change", [{"secret": OTHER}, {"term": "2027S"}])
def test_another_secret_or_term_is_refused(tmp_path: Path, change: dict[str, object]) -> None:
    """The folder of another secret or term is left alone; with force old students keep their numbers."""
    run(tmp_path)
    before = snapshot(tmp_path)
    with pytest.raises(UsageError, match="was made with another secret or term; choose another folder, or --force"):
        run(tmp_path, **change)
    assert snapshot(tmp_path) == before
    done = run(tmp_path, [*CLASS, Student("s9")], force=True, **change)
    assert (done.new, len(done.unchanged)) == (("s9",), 3)


def test_files_that_changed_are_left_unless_forced(tmp_path: Path) -> None:
    """A folder that would be rendered otherwise today is left and named; force renders it again."""
    run(tmp_path)
    before = snapshot(tmp_path)

    def newer(problem: Problem) -> dict[str, str]:
        return files_of(problem) | {"figures/graph.svg": "<svg></svg>"}

    done = run(tmp_path, render=newer)
    assert "3 folders were left although their files would be rendered otherwise today (s3, s1, Zoë Müller)" in (
        done.text()
    )
    assert snapshot(tmp_path) == before
    assert len(run(tmp_path, render=newer, force=True).rewritten) == 3
    assert (tmp_path / "students/s1/figures/graph.svg").read_text() == "<svg></svg>"
    assert run(tmp_path, render=newer).text() == "0 new, 3 unchanged, 0 rewritten."


def test_a_killed_release_goes_on(tmp_path: Path) -> None:
    """Where a run stopped half-way no folder is half there, and the next run finishes with the same bytes."""
    run(tmp_path / "whole")

    def fail(problem: Problem) -> dict[str, str]:
        if "zips" in {path.name for path in (tmp_path / "half").iterdir()}:
            raise KeyboardInterrupt
        return files_of(problem)

    with pytest.raises(KeyboardInterrupt):
        run(tmp_path / "half", render=fail)
    assert len(list((tmp_path / "half" / "students").iterdir())) == 1
    (tmp_path / "half" / "students" / ".unfinished-x").mkdir()
    assert run(tmp_path / "half").text() == "2 new, 1 unchanged, 0 rewritten."
    whole, half = snapshot(tmp_path / "whole"), snapshot(tmp_path / "half")
    assert {name: data for name, (data, _) in whole.items()} == {name: data for name, (data, _) in half.items()}


def test_what_is_not_accepted_is_counted(tmp_path: Path) -> None:
    """A further demand is heard, redrawn variants are counted, and notes for staff lie among theirs."""
    done = run(tmp_path, accept=lambda variant: variant.x1[1] > 2, notes={"mistakes.txt": "Family A shows 9.\n"})
    assert all(variant.x1[1] > 2 for variant in read_ledger(tmp_path / LEDGER))
    assert done.redrawn["not accepted"] > 0
    assert f"{done.redrawn['not accepted']} draws redrawn: not accepted." in done.text()
    assert (tmp_path / "staff" / "mistakes.txt").read_text() == "Family A shows 9.\n"


@pytest.mark.parametrize("mix", [{}, {"A": 0}, {"A": -1, "B": 2}])
def test_a_mix_needs_a_family(tmp_path: Path, mix: dict[str, int]) -> None:
    """A mix without a positive weight is refused before anything is written."""
    with pytest.raises(UsageError, match="The mix of families is"):
        run(tmp_path / "out", mix=mix)
    assert not (tmp_path / "out").exists()


def test_a_folder_that_cannot_be_written_is_named(tmp_path: Path) -> None:
    """Where a file stands in the way, the message says which."""
    (tmp_path / "out").write_text("")
    with pytest.raises(UsageError, match=r"Release folder .*out cannot be written \(.*\)"):
        run(tmp_path / "out")


def secrets_of(variant: Variant) -> dict[str, str]:
    """What must not be readable: answer and step in every spelling that a file may have."""
    spellings = {}
    for name, values in (("answer", variant.x1), ("step", variant.step)):
        short = [decimal(value) for value in values[1:]]
        plain = [repr(float(value)) for value in values[1:]]
        for words in (short, plain):
            for separator in (", ", ",", " ", "\n", "\t", "; ", " & ", " | "):
                spellings[f"{name} {separator!r} {words[0]}"] = separator.join(words)
    return spellings


def test_no_student_folder_holds_an_answer(tmp_path: Path) -> None:
    """In the real rendered folders of all families no file holds an answer, the secret, or anybody else's name."""
    students = [Student(f"student-{k}") for k in range(6)]
    letters = dict.fromkeys("WABCDL", 1)
    release(students, SECRET, "2026S", letters, tmp_path, render=render_folder)
    ledger = read_ledger(tmp_path / LEDGER)
    assert len({variant.family for variant in ledger}) > 1
    staff = {path.name for path in (tmp_path / "staff").iterdir()}
    for variant in ledger:
        for path in (tmp_path / "students" / variant.student_id).rglob("*"):
            text = path.read_text("utf-8")
            plain = json.dumps(json.loads(text), ensure_ascii=False) if path.suffix == ".ipynb" else text
            for content in (text, plain, " ".join(plain.split())):
                assert not {name for name, words in secrets_of(variant).items() if words in content}, path
                assert SECRET.key.decode() not in content
                assert not [name for name in staff if name in content]
                assert not [other for other in students if other.student_id in content]
        page = (tmp_path / "staff" / "solutions" / f"{variant.student_id}.md").read_text("utf-8")
        assert any(words in page for words in secrets_of(variant).values())
