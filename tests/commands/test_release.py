"""`autograder release`: real folders for a class, in one command, and safe to run again."""

from __future__ import annotations

import json
import shutil
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

from autograder.commands._class import demand_of, drawn_ledger, known_mistakes
from autograder.course import load_course
from autograder.engine.exam import read_exam
from autograder.problems.discriminating import unseen
from autograder.problems.hand_solution import hand_solution
from autograder.problems.roster import read_roster
from autograder.problems.secret import Secret
from autograder.render.handout import render_folder
from tests.commands.released import CLASS, SECRET, TERM, files_of_the_course, ledger_of, module, options

Ended = tuple[int, str, str]
Run = Callable[..., Ended]


def snapshot(folder: Path) -> dict[str, tuple[bytes, int]]:
    """Read every file below a folder, with its time of change."""
    return {
        path.relative_to(folder).as_posix(): (path.read_bytes(), path.stat().st_mtime_ns)
        for path in folder.rglob("*")
        if path.is_file()
    }


@pytest.fixture
def release(run: Run, tmp_path: Path) -> Callable[..., Ended]:
    """A function that releases the class into `release`, with further options."""
    files = files_of_the_course(tmp_path)

    def released(*more: object) -> Ended:
        return run("release", *options(files), "-o", tmp_path / "release", *more)

    return released


def test_a_student_gets_a_whole_folder_and_a_zip(release: Callable[..., Ended], tmp_path: Path) -> None:
    """Handout, notebooks, stub, provided files and pictures, with the student's own numbers; the zip holds the same."""
    code, out, err = release()
    assert (code, out.splitlines()[0]) == (0, "3 new, 0 unchanged, 0 rewritten.")
    assert "drew 3 of 3" in err
    assert "wrote 3 of 3" in err
    for variant in ledger_of(tmp_path / "release"):
        folder = tmp_path / "release" / "students" / variant.student_id
        files = {path.name: path.read_text(encoding="utf-8") for path in folder.iterdir()}
        assert files == render_folder(variant.problem)
        assert {
            "README.md",
            "handout.html",
            "slam1d.ipynb",
            "explore.ipynb",
            "slam1d.py",
            "posegraph.py",
            "self_check.py",
        } < set(files)
        assert str(variant.graph.measurements.tolist()) in files["slam1d.py"]
        assert json.loads(files["slam1d.ipynb"])["metadata"]["slam1d"] == {"variant": variant.identifier}
        with zipfile.ZipFile(tmp_path / "release" / "zips" / f"{variant.student_id}.zip") as archive:
            held = {Path(name).name: archive.read(name).decode() for name in archive.namelist()}
        assert held == files


def test_staff_get_what_they_mark_with(release: Callable[..., Ended], tmp_path: Path) -> None:
    """Ledger, keys, the solution by hand, model answers, and what the families cannot show; none of it for students."""
    release()
    staff = tmp_path / "release" / "staff"
    assert {path.name for path in staff.iterdir()} == {
        "variants.csv",
        "keys.csv",
        "exam",
        "mail.csv",
        "release.json",
        "mistakes.txt",
        "solutions",
        "worked",
    }
    for variant in ledger_of(tmp_path / "release"):
        assert (staff / "solutions" / f"{variant.student_id}.md").read_text("utf-8") == hand_solution(variant)
        assert variant.identifier in (staff / "worked" / f"{variant.student_id}.md").read_text("utf-8")
        assert variant.identifier in (staff / "worked" / f"{variant.student_id}.html").read_text("utf-8")
        assert json.loads((staff / "worked" / f"{variant.student_id}.ipynb").read_text("utf-8"))["nbformat"] == 4
    assert (staff / "mistakes.txt").read_text().startswith("Family A shows ")
    assert SECRET not in "".join(path.read_text("utf-8", "replace") for path in staff.rglob("*") if path.is_file())


def test_handout_and_notebook_tell_what_the_course_says(release: Callable[..., Ended], tmp_path: Path) -> None:
    """Title, points, share and due date are the course's, in all three pages that a student reads."""
    (tmp_path / "course.toml").write_text(
        'title = "ROB-5: walks & loops"\n[points]\nresidual = 12.5\nanswers = 10\nwritten = 0\nrange_factor = 3\n'
        "[grading]\nfollow_through = 0.25\n[late]\ndue = 2026-12-04T22:59:00Z\nzone = 'Europe/Berlin'\n"
    )
    release("--course", tmp_path / "course.toml")
    folder = tmp_path / "release" / "students" / "s1"
    handout = (folder / "README.md").read_text("utf-8")
    cells = json.loads((folder / "slam1d.ipynb").read_text("utf-8"))["cells"]
    notebook = "".join("".join(cell["source"]) for cell in cells)
    page = (folder / "handout.html").read_text("utf-8")
    rows = ("| `residual` | 12.5 |", "| `iterates` | 6 |", "| `conclusion` | 4 |", "| **together** | **97.5** |")
    for text in (handout, notebook):
        assert text.startswith("# ROB-5: walks & loops\n")
        assert "Friday, 4 December 2026, 23:59 (Europe/Berlin, UTC+01:00)" in text
        assert [row for row in (*rows, "| bonus: `range_factor` (see `explore.ipynb`) | 3 |") if row not in text] == []
        assert "your words for question" not in text
    assert "it keeps 25 % of its points" in handout
    assert "A mistake is paid for once" not in handout
    assert "<title>ROB-5: walks &amp; loops</title>" in page
    assert "Friday, 4 December 2026" in page


def test_the_graders_share_one_exam(release: Callable[..., Ended], run: Run, tmp_path: Path) -> None:
    """It lies beside the keys, is the one that `grade` would draw, stays as it is, and the printed command takes it."""
    exam = tmp_path / "release" / "staff" / "exam"
    out = release()[1]
    assert f"--exam {exam}" in out
    held = read_exam(exam)
    assert (held.seed, held.examples) == (Secret(SECRET.encode()).seed(TERM), 200)
    (tmp_path / "course.toml").write_text("[grading]\nseed = 7\nexamples = 3\n")
    _, out, _ = release("--course", tmp_path / "course.toml")
    assert f"{exam} was left, with seed {held.seed} and 200 cases a stage" in out
    assert read_exam(exam).digest == held.digest
    release("--course", tmp_path / "course.toml", "--force")
    assert (read_exam(exam).seed, read_exam(exam).examples) == (7, 3)


def test_running_it_again_changes_nothing(release: Callable[..., Ended], tmp_path: Path) -> None:
    """A second run, and one after a student was added, leave every file of the others alone."""
    release()
    before = snapshot(tmp_path / "release")
    code, out, _ = release()
    assert (code, out.splitlines()[0]) == (0, "0 new, 3 unchanged, 0 rewritten.")
    assert snapshot(tmp_path / "release") == before
    (tmp_path / "class.csv").write_text(CLASS + "a0,Di Oak,di@x.org,2\n")
    assert release()[1].startswith("1 new, 3 unchanged")
    after = snapshot(tmp_path / "release")
    changed = {name for name in after if after[name] != before.get(name)}
    assert {name for name in changed if "a0" not in name} == {"staff/variants.csv", "staff/keys.csv", "staff/mail.csv"}


def test_another_secret_or_term_is_refused(release: Callable[..., Ended], tmp_path: Path) -> None:
    """The folder of another secret or term is left alone, with exit code 2 and a sentence."""
    release()
    before = snapshot(tmp_path / "release")
    code, _, err = release("--term", "2027S")
    assert code == 2
    assert "was made with another secret or term" in err
    (tmp_path / "secret.txt").write_text("another secret of this course")
    assert release()[0] == 2
    assert snapshot(tmp_path / "release") == before
    assert release("--force")[0] == 0


@pytest.mark.slow
def test_a_second_release_after_mistakes_loses_nothing(release: Callable[..., Ended], run: Run, tmp_path: Path) -> None:
    """Another secret, term, mix or roster, a lost folder: what was handed out stays, and the class is graded on it."""
    assert release()[0] == 0
    first = snapshot(tmp_path / "release")
    course = tmp_path / "course.toml"
    course.write_text('[variants]\nfamilies = ["B"]\n')
    for mistake, words in (
        (("--course", course), "mix of families (A)"),
        (("--family", "A", "--family", "W"), "mix of families (A)"),
        (("--term", "2027S"), "secret or term"),
    ):
        code, _, err = release(*mistake)
        assert code == 2
        assert f"was made with another {words}; choose another folder" in err
    assert snapshot(tmp_path / "release") == first
    assert json.loads((tmp_path / "release/staff/release.json").read_text())["mix"] == {"A": 1}
    shutil.rmtree(tmp_path / "release/students/s2")
    (tmp_path / "class.csv").write_text(CLASS.replace("s1,Ann Lee,ann@x.org,1\n", "") + "s4,Di Oak,di@x.org,2\n")
    code, out, err = release("--family", "B", "--force")
    assert code == 0, err
    assert "s1" in out + err  # who is gone from the roster is named
    after = snapshot(tmp_path / "release")
    lost = {name for name in first if name not in after}
    assert not lost
    ours = {name for name, (data, _) in first.items() if after[name][0] != data}
    assert {name.removeprefix("staff/") for name in ours} == {
        "variants.csv",
        "keys.csv",
        "release.json",
        "mistakes.txt",
        "mail.csv",
    }
    lines = {name: after[f"staff/{name}"][0].splitlines() for name in ("variants.csv", "keys.csv")}
    assert all(line in lines[name] for name in lines for line in first[f"staff/{name}"][0].splitlines())
    assert {one.student_id: one.family for one in ledger_of(tmp_path / "release")} == {
        "s1": "A", "s2": "A", "s3": "A", "s4": "B",
    }  # fmt: skip
    uploads = tmp_path / "uploads"
    uploads.mkdir()
    for one in ledger_of(tmp_path / "release"):
        (uploads / f"{one.student_id}.py").write_text(module(one))
    ledger = ("--ledger", tmp_path / "release/staff/variants.csv")
    assert run("grade", uploads, "-o", tmp_path / "out", *ledger, "--examples", 3, "--workers", 1)[0] == 0
    for path in (tmp_path / "out/results").iterdir():
        graded = json.loads(path.read_bytes())
        answers = next(stage for stage in graded["stages"] if stage["name"] == "answers")
        assert (answers["score"], graded["flags"]) == (5.0, [])


def test_families_come_from_the_command_line_or_the_course(release: Callable[..., Ended], tmp_path: Path) -> None:
    """`--family`, given again, is a mix; without it the course file decides."""
    (tmp_path / "course.toml").write_text('[variants]\nfamilies = ["interior-loop"]\n')
    assert release("--course", tmp_path / "course.toml")[0] == 0
    assert {variant.family for variant in ledger_of(tmp_path / "release")} == {"B"}
    release("-o", tmp_path / "other", "--family", "C", "--family", "W:poses=6")
    assert {variant.family for variant in ledger_of(tmp_path / "other")} <= {"C", "W:poses=6"}


@pytest.mark.parametrize(
    ("more", "words"),
    [
        (("--family", "Q"), "There is no family 'Q'"),
        (("--term", " "), "--term is empty"),
        (("--secret-file", "nowhere.txt"), "Secret file nowhere.txt cannot be read"),
        (("--roster", "nowhere.csv"), "Roster nowhere.csv cannot be read"),
    ],
)
def test_bad_input_is_one_line(
    release: Callable[..., Ended], tmp_path: Path, more: tuple[str, ...], words: str
) -> None:
    """What cannot be used is named, the exit code is 2, and nothing is written."""
    code, out, err = release(*more)
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert words in err
    assert not (tmp_path / "release").exists()


def test_a_line_of_the_roster_is_named(release: Callable[..., Ended], tmp_path: Path) -> None:
    """A roster with a doubled id is refused with its line."""
    (tmp_path / "class.csv").write_text(CLASS + "s1,Ann Lee,ann@x.org,1\n")
    code, _, err = release()
    assert code == 2
    assert "line 5: student_id 's1' stands in line 2 already" in err


def test_a_family_must_be_text_in_the_course_file(tmp_path: Path) -> None:
    """`families` is a list of names."""
    (tmp_path / "course.toml").write_text("[variants]\nfamilies = []\n")
    with pytest.raises(Exception, match=r"line 2: \[variants\] families is \[\], expected a list of families"):
        load_course(tmp_path / "course.toml")


def test_what_is_drawn_again_is_what_was_released(release: Callable[..., Ended], tmp_path: Path) -> None:
    """Without the ledger, roster, secret and term give the same variants; each shows all that its family can."""
    release()
    students = read_roster(tmp_path / "class.csv")
    drawn = drawn_ledger(students, Secret(SECRET.encode()), TERM, {"A": 1})
    released = list(ledger_of(tmp_path / "release"))
    assert [variant.exact for variant in drawn] == [variant.exact for variant in released]
    assert all(demand_of({"A": 1}).accept(variant) for variant in released[:1])
    assert len(unseen(released[0], known_mistakes())) < len(known_mistakes()) / 2


def test_model_answers_are_released_after_the_due_date_and_not_before(
    release: Callable[..., Ended], tmp_path: Path
) -> None:
    """Each student's page has their own numbers and no marking guide; before the due date nothing is written."""
    course = tmp_path / "course.toml"
    for due, code in (("2999-01-01T12:00:00+00:00", 2), ("2020-01-01T12:00:00+00:00", 0)):
        course.write_text(f"[late]\ndue = {due}\n")
        ended, _out, err = release("--solutions", "--course", course)
        assert ended == code
        assert (tmp_path / "release" / "solutions").exists() == (code == 0)
        assert ("until then somebody may hand in" in err) == (code == 2)
    for variant in ledger_of(tmp_path / "release"):
        page = (tmp_path / "release" / "solutions" / f"{variant.student_id}.html").read_text(encoding="utf-8")
        assert variant.identifier in page
        assert "<strong>linear</strong>" in page
        assert "Along the corridor" in page
        assert "Marking guide" not in page
    assert release("--solutions", "--force")[0] == 2
