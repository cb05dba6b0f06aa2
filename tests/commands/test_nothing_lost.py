"""A class of 81 through a night of mistakes: who belongs to its folder, in every command that reads it."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.intake.making import CODE
from tests.marking.written import answered
from tests.reports.examples import result

Ended = tuple[int, str, str]
CLASS = [f"s{number:02}" for number in range(81)]


@pytest.fixture
def grade(run: Callable[..., Ended], graded: dict[str, Any], tmp_path: Path) -> Callable[..., str]:
    """Grade what lies in a place now; everybody is found by the roster's id, whatever the file is called."""

    def grade(place: str, *more: object) -> str:
        path = tmp_path / place
        files = [path] if path.is_file() else sorted(path.iterdir())
        graded["results"] = [result(file.stem, student_id=file.stem[:3]) for file in files]
        code, _, err = run("grade", path, "-o", tmp_path / "out", *more)
        assert code == 0, err
        return err

    (tmp_path / "uploads").mkdir()
    for name in CLASS[:80]:
        (tmp_path / "uploads" / f"{name}.py").write_text(CODE)
    grade("uploads")
    return grade


def rows(out: Path) -> list[str]:
    """List the submissions of grades.csv."""
    return [row["submission"] for row in csv.DictReader(io.StringIO((out / "grades.csv").read_text("utf-8-sig")))]


def everywhere(run: Callable[..., Ended], folder: Path) -> set[str]:
    """Ask every command that reads the folder for its students; all must say the same."""
    out = folder / "out"
    assert run("report", out)[0] == 0
    found = [{name[:3] for name in rows(out)}]
    sheet = 'Identifier,"Email address",Grade,"Maximum grade"\n'
    sheet += "".join(f"Participant 1{name[1:]},{name},,90\n" for name in CLASS)
    book = "Student,ID,SIS User ID,Section,Homework (7)\n    Points Possible,,,,90\n"
    book += "".join(f'"Doe, {name}",1{name[1:]},{name},A,\n' for name in CLASS)
    for system, option, table, written, who, mark in (
        ("moodle", "--worksheet", sheet, "worksheet.csv", "Email address", "Grade"),
        ("canvas", "--gradebook", book, "gradebook.csv", "SIS User ID", "Homework (7)"),
    ):
        (folder / "table.csv").write_text(table)
        code, _, err = run("export", system, out, option, folder / "table.csv", "-o", folder / system)
        assert code == 0, err
        text = (folder / system / written).read_text()
        found.append({row[who] for row in csv.DictReader(io.StringIO(text)) if row[mark] and row[who]})
    (folder / "roster.csv").write_text("student_id\n" + "\n".join(CLASS) + "\n")
    code, _, err = run("export", "mailmerge", out, "-o", folder / "mail.csv")
    assert code == 0, err
    mail = csv.DictReader(io.StringIO((folder / "mail.csv").read_text("utf-8-sig")))
    found.append({row["student_id"] for row in mail})
    assert all(one == found[0] for one in found), found
    return found[0]


def test_one_late_file_without_only_joins_the_class(
    grade: Callable[..., str], run: Callable[..., Ended], tmp_path: Path
) -> None:
    """It lies elsewhere and is given by itself: 80 rows become 81, and not 1."""
    (tmp_path / "late").mkdir()
    (tmp_path / "late/s80.py").write_text(CODE)
    err = grade("late/s80.py")
    assert "80 submissions are not in what was given now and stay (s00, s01, s02, s03, s04, ...)" in err
    assert len(rows(tmp_path / "out")) == 81
    assert everywhere(run, tmp_path) == set(CLASS)


def test_a_removed_upload_comes_back_with_no_command(
    grade: Callable[..., str], run: Callable[..., Ended], tmp_path: Path
) -> None:
    """It is kept aside and said once; put back it counts again; forgotten it is gone."""
    file = tmp_path / "uploads/s07.py"
    file.unlink()
    assert "1 submission was handed in before and is gone now (s07): kept aside;" in grade("uploads")
    left = set(CLASS[:80]) - {"s07"}
    assert everywhere(run, tmp_path) == left
    assert (tmp_path / "out/results/s07.json").exists()
    assert not (tmp_path / "out/feedback/s07.html").exists()
    grade("uploads", "--only", "s08")
    assert everywhere(run, tmp_path) == left
    file.write_text(CODE)
    assert "1 submission was kept aside and handed in again: s07." in grade("uploads")
    assert everywhere(run, tmp_path) == set(CLASS[:80])
    file.unlink()
    grade("uploads")
    assert run("report", tmp_path / "out", "--forget", "s07")[0] == 0
    assert not (tmp_path / "out/results/s07.json").exists()


def test_a_renamed_upload_blocks_no_export(
    grade: Callable[..., str], run: Callable[..., Ended], tmp_path: Path
) -> None:
    """The old result is one of the same student, and is kept aside: no line is claimed twice."""
    (tmp_path / "uploads/s07.py").rename(tmp_path / "uploads/s07_final.py")
    assert "gone now (s07): kept aside" in grade("uploads")
    assert everywhere(run, tmp_path) == set(CLASS[:80])
    assert "s07_final" in rows(tmp_path / "out")
    assert len(rows(tmp_path / "out")) == 80


def test_what_is_refused_changes_nobodys_membership(
    grade: Callable[..., str], run: Callable[..., Ended], tmp_path: Path
) -> None:
    """The command ends with 2 before it has written down who was handed in and whose it is."""
    out = tmp_path / "out"
    before = {path: path.read_bytes() for path in out.rglob("*") if path.is_file()}
    (tmp_path / "uploads/s07.py").unlink()
    (tmp_path / "broken.exam").write_bytes(b"no exam")
    command = ("grade", tmp_path / "uploads", "-o", out, "--is", "s08=x8", "--exam", tmp_path / "broken.exam")
    assert run(*command)[0] == 2
    assert {path: path.read_bytes() for path in out.rglob("*") if path.is_file()} == before


def test_marks_outlive_a_night_of_mistakes(
    run: Callable[..., Ended], graded: dict[str, Any], upload: Path, tmp_path: Path
) -> None:
    """Marks, an override and an owner stand after old sheets, a forgotten course, one late file and a lost upload."""
    out, course = tmp_path / "out", tmp_path / "course.toml"
    course.write_text('title = "Robotics"\n[points]\nwritten = 10\n')
    (upload.parent / "ann.py").write_text(CODE)
    graded["results"] = [answered("alice", student_id="s1"), answered("ann", student_id="s2")]
    grade = ("grade", upload.parent, "-o", out)
    assert run(*grade, "--is", "alice=s1")[0] == 0
    empty = (out / "written.csv").read_text("utf-8-sig")
    filled = tmp_path / "filled.csv"
    rows = list(csv.DictReader(io.StringIO(empty)))
    with filled.open("w", newline="") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        writer.writerows([row | {"points": row["max_points"], "comment": "good"} for row in rows])
    assert run("report", out, "--marks", filled)[0] == 0
    (out / "overrides.csv").write_text(
        "student,stage,points,reason,who,when\nalice,residual,1,copied,Prof,2026-11-20\n", encoding="utf-8"
    )
    assert run("report", out)[0] == 0
    before = _scores(out)
    assert before["ann"] == 100.0
    kept = {name: (out / name).read_bytes() for name in ("marks.csv", "overrides.csv", "owners.csv")}
    (tmp_path / "old.csv").write_text(empty, encoding="utf-8")
    mistakes: list[tuple[object, ...]] = [
        ("report", out, "--marks", tmp_path / "old.csv"),  # the sheet of before anybody read
        ("report", out, "--marks", filled),  # read a second time
        (*grade, "--course", course),  # other points,
        grade,  # and forgotten again
        (*grade, "--only", "ann"),
        ("grade", upload.parent / "ann.py", "-o", out),
        ("report", out),
    ]
    for mistake in mistakes:
        run(*mistake)
        assert {name: (out / name).read_bytes() for name in kept} == kept, mistake
    assert _scores(out) == before
    upload.unlink()
    graded["results"] = graded["results"][1:]
    assert "is gone now (alice): kept aside" in run(*grade)[2]
    upload.write_text(CODE)
    graded["results"] = [answered("alice", student_id="s1"), *graded["results"]]
    run(*grade)
    assert _scores(out) == before
    assert {name: (out / name).read_bytes() for name in kept} == kept


def _scores(out: Path) -> dict[str, float]:
    text = (out / "grades.csv").read_text("utf-8-sig")
    return {row["submission"]: float(row["score"]) for row in csv.DictReader(io.StringIO(text))}
