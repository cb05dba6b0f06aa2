"""What people decide goes through `report`, `mark` and `diff`, stays on disk, and survives a run of the grader."""

from __future__ import annotations

import csv
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from autograder.desk.server import Desk
from autograder.marking.anonymous import read_key
from tests.marking.written import EVIL, answered, written_class

Ended = tuple[int, str, str]
Run = Callable[..., Ended]


@pytest.fixture
def out(run: Run, graded: Any, upload: Path, tmp_path: Path) -> Path:
    """Grade a class with written answers."""
    graded["results"] = written_class()
    code, _, _ = run("grade", upload, "-o", tmp_path / "out")
    assert code == 0
    return tmp_path / "out"


def rows(path: Path) -> dict[str, dict[str, str]]:
    """Read grades.csv by submission."""
    with path.open(newline="", encoding="utf-8") as file:
        return {row["submission"]: row for row in csv.DictReader(file)}


def fill(out: Path, **points: str) -> Path:
    """Fill the sheet in as a reader would: ann2=1.5."""
    with (out / "written.csv").open(newline="", encoding="utf-8") as file:
        sheet = list(csv.DictReader(file))
    for row in sheet:
        row["points"] = points.get(f"{row['submission']}{row['question']}", row["points"])
        row["comment"] = "see page 3" if row["points"] else ""
    path = out.parent / "filled.csv"
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(sheet[0]))
        writer.writeheader()
        writer.writerows(sheet)
    return path


def snapshot(out: Path) -> dict[str, bytes]:
    """Read every file of a run."""
    return {str(path.relative_to(out)): path.read_bytes() for path in sorted(out.rglob("*")) if path.is_file()}


def test_every_report_says_provisional_of_95(run: Run, out: Path) -> None:
    """Table, class page, student's page, grades.csv and forum post, as long as points wait."""
    words = "provisional, of 95"
    assert words in run("report", out)[1]
    assert words in run("report", out, "--format", "md")[1]
    for name in ("report.html", "feedback/ann.html", "grades.csv"):
        assert words in (out / name).read_text(encoding="utf-8").lower(), name


def test_a_filled_sheet_reaches_every_report_and_filling_it_twice_changes_nothing(run: Run, out: Path) -> None:
    """Totals, the student's page with the comment, and who moved by how much."""
    before = (out / "results" / "ann.json").read_bytes()
    code, text, err = run("report", out, "--marks", fill(out, ann2="1.5", ann3="3", eve2="0", eve3="0", bob3="2"))
    assert code == 0
    assert "5 marks, 5 of them new or changed" in err
    assert "ann  95 -> 99.5 (+4.5)" in text
    assert rows(out / "grades.csv")["ann"]["score"] == "99.5"
    assert "rovisional" not in text + (out / "report.html").read_text() + (out / "grades.csv").read_text()
    assert "see page 3" in (out / "feedback" / "ann.html").read_text()
    assert (out / "results" / "ann.json").read_bytes() == before, "the machine's verdict stays"
    after = snapshot(out)
    code, text, err = run("report", out, "--marks", out / "written.csv")
    assert code == 0
    assert "0 of them new or changed" in err
    assert "changed:" not in text
    assert snapshot(out) == after


def test_marks_survive_a_new_run_of_the_grader(run: Run, out: Path, upload: Path) -> None:
    """The grader writes what it knows; what people gave is merged in again."""
    run("report", out, "--marks", fill(out, ann2="2", ann3="3"))
    marks = (out / "marks.csv").read_bytes()
    assert run("grade", upload, "-o", out, "--fresh")[0] == 0
    assert (out / "marks.csv").read_bytes() == marks
    assert rows(out / "grades.csv")["ann"]["score"] == "100"


def test_a_sheet_with_a_mistake_changes_nothing(run: Run, out: Path) -> None:
    """Exit 2, one line with line and reason, and no mark is stored."""
    before = snapshot(out)
    code, text, err = run("report", out, "--marks", fill(out, ann2="7", bob3="x"))
    assert (code, text) == (2, "")
    assert "Line 2: 7 points, but question 2 has 2" in err
    assert "Line 5: points are 'x'" in err
    assert snapshot(out) == before


def test_a_half_filled_sheet_says_what_is_missing(run: Run, out: Path) -> None:
    """Line and reason; these stay provisional."""
    _, _, err = run("report", out, "--marks", fill(out, ann2="2"))
    assert "no points for question 3 of ann; it stays provisional" in err


def test_a_sheet_that_is_being_filled_in_place_is_never_written_over(run: Run, out: Path, upload: Path) -> None:
    """Whoever types into OUT/written.csv and forgets --marks loses nothing."""
    typed = fill(out, ann2="2").read_bytes()
    (out / "written.csv").write_bytes(typed)
    for command in (("report", out), ("grade", upload, "-o", out), ("report", out, "--anonymous")):
        _, _, err = run(*command)
        assert "holds marks that are not read yet" in err
        assert (out / "written.csv").read_bytes() == typed


def test_anonymous_pages_name_nobody_and_come_back(run: Run, out: Path) -> None:
    """The sheet with other names fills the right marks; only staff have the key."""
    run("report", out, "--anonymous")
    page, sheet = (out / "written.html").read_text(), (out / "written.csv").read_text()
    for name in ("ann", "bob", "eve"):
        assert f">{name}<" not in page
        assert f"\n{name}," not in sheet
    back = {submission: name for name, submission in read_key(out).items()}
    filled = fill(out, **{f"{back['ann']}2": "1", f"{back['ann']}3": "1"})
    assert run("report", out, "--marks", filled)[0] == 0
    assert rows(out / "grades.csv")["ann"]["score"] == "97"


def test_changed_points_move_marks_without_running_code(run: Run, out: Path, tmp_path: Path, graded: Any) -> None:
    """The change is shown, is kept for later commands, and can be taken back."""
    course = tmp_path / "course.toml"
    course.write_text("[points]\nresidual = 5\n")
    asked = dict(graded)
    code, text, _ = run("report", out, "--course", course)
    assert code == 0
    assert graded == asked
    assert "4 totals have changed: 0 up, 4 down" in text
    assert "ann  95 -> 85 (-10)" in text
    assert (rows(out / "grades.csv")["ann"]["score"], rows(out / "grades.csv")["ann"]["max_score"]) == ("85", "90")
    assert (out / "changes.csv").read_text().splitlines()[1] == "ann,95,85,-10"
    assert "changed:" not in run("report", out)[1]
    course.write_text("")
    assert "0 down" in run("report", out, "--course", course)[1]


def test_overrides_survive_a_run_and_show_on_the_students_page(run: Run, out: Path, upload: Path) -> None:
    """With reason, who and when, escaped."""
    line = f'ann,residual,12,"copied {EVIL.replace(chr(34), chr(39))}",Prof,2026-11-22\n'
    (out / "overrides.csv").write_text("student,stage,points,reason,who,when\n" + line)
    for command in (("report", out), ("grade", upload, "-o", out)):
        assert run(*command)[0] == 0
        page = (out / "feedback" / "ann.html").read_text()
        assert "residual set to 12, was 15: copied" in page
        assert "(Prof, 2026-11-22)" in page
        assert "<script>document" not in page
        assert rows(out / "grades.csv")["ann"]["score"] == "92"


def test_a_broken_overrides_file_is_told_before_grading(run: Run, out: Path, upload: Path, graded: Any) -> None:
    """Not after an hour."""
    (out / "overrides.csv").write_text("student,stage,points,reason,who,when\nann,residual,lots,r,w,d\n")
    graded["raises"] = AssertionError("the engine was asked")
    code, _, err = run("grade", upload, "-o", out)
    assert code == 2
    assert "Line 2: points are 'lots'" in err


def test_feedback_before_the_due_date_is_that_of_the_course(run: Run, out: Path, tmp_path: Path) -> None:
    """And afterwards another."""
    course = tmp_path / "course.toml"
    for year, shown in ((2999, False), (2001, True)):
        course.write_text(f'[feedback]\nbefore_due = "score"\n[late]\ndue = {year}-01-01T00:00:00Z\n')
        run("report", out, "--course", course)
        assert ("What passed" in (out / "feedback" / "ann.html").read_text()) == shown


def test_an_interrupted_run_keeps_everybody_who_was_graded_before(
    run: Run, out: Path, upload: Path, graded: Any
) -> None:
    """grades.csv holds everybody who belongs to the folder, and nobody drops out by an interruption."""
    for name in ("ann", "bob"):
        (upload.parent / f"{name}.py").write_text("x = 1\n")
    graded.update(results=[answered("ann")], interrupted=True)
    assert run("grade", upload.parent, "-o", out)[0] == 130
    assert list(rows(out / "grades.csv")) == ["ann", "bob", "eve", "sam"]


def test_only_merges_one_into_the_class(run: Run, out: Path, upload: Path, graded: Any) -> None:
    """The others keep their rows."""
    graded["results"] = [answered("alice")]
    assert run("grade", upload, "-o", out, "--only", "alice")[0] == 0
    assert list(rows(out / "grades.csv")) == ["alice", "ann", "bob", "eve", "sam"]


def test_diff_says_whose_mark_moved_by_which_check_and_why(
    run: Run, out: Path, upload: Path, graded: Any, tmp_path: Path
) -> None:
    """As text, and as data."""
    graded["results"] = [answered("ann"), answered("bob", {})]
    run("grade", upload, "-o", tmp_path / "again")
    (tmp_path / "again" / "overrides.csv").write_text(
        "student,stage,points,reason,who,when\nann,residual,12,copied,Prof,today\n"
    )
    code, text, _ = run("diff", out, tmp_path / "again")
    assert code == 0
    assert "ann  95 -> 92 (-3)" in text
    assert "residual set to 12, was 15: copied (Prof, today)" in text
    assert "eve  95 -> --" in text
    assert text.splitlines()[-1] == "4 differ, 0 are the same."
    lines = [json.loads(line) for line in run("diff", out, tmp_path / "again", "--json")[1].splitlines()]
    assert [line["submission"] for line in lines] == ["ann", "bob", "eve", "sam"]
    assert run("diff", out, out)[1] == "0 differ, 4 are the same.\n"


def test_mark_serves_the_pile_and_writes_the_reports_at_the_end(
    run: Run, out: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its address is printed; what was marked is in the reports when it ends."""

    def serve(desk: Desk, poll_interval: float = 0.5) -> None:
        desk.pile.give(0, "2", "")
        raise KeyboardInterrupt

    monkeypatch.setattr(Desk, "serve_forever", serve)
    code, text, err = run("mark", out, "--no-browser")
    assert code == 0
    assert text.startswith("http://127.0.0.1:")
    assert "5 of 5 answers wait" in err
    assert "ann  95 -> 97 (+2)" in err
    assert rows(out / "grades.csv")["ann"]["score"] == "97"


def test_exports_show_what_the_reports_show(run: Run, out: Path, tmp_path: Path) -> None:
    """Marks, comments and overrides reach the files for other systems."""
    run("report", out, "--marks", fill(out, ann2="2", ann3="2"))
    (out / "overrides.csv").write_text("student,stage,points,reason,who,when\nann,residual,14,late proof,Prof,today\n")
    assert run("export", "mailmerge", out, "-o", tmp_path / "mail.csv")[0] == 0
    [ann] = [row for name, row in rows(tmp_path / "mail.csv").items() if name == "ann"]
    assert ann["score"] == "98"
    assert "Question 2: see page 3" in ann["feedback"]
    assert "residual set to 14, was 15: late proof (Prof, today)" in ann["feedback"]


def test_other_settings_for_the_same_folder_are_announced(run: Run, out: Path, upload: Path, tmp_path: Path) -> None:
    """The same command twice says nothing; a forgotten --course does."""
    course = tmp_path / "course.toml"
    course.write_text("[points]\nresidual = 5\n")
    words = "written with other settings"
    assert words not in run("grade", upload, "-o", out, "--feedback", "full")[2]
    assert words in run("grade", upload, "-o", out, "--course", course)[2]
    assert words not in run("grade", upload, "-o", out, "--course", course)[2]
    assert words in run("grade", upload, "-o", out, "--feedback", "hint")[2]
    assert words not in run("grade", upload, "-o", out, "--feedback", "hint")[2]
