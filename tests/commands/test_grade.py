"""`autograder grade`: what it prints where, what it asks of the engine, and how it ends."""

from __future__ import annotations

import io
import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from autograder.commands._progress import Lines, line, progress
from autograder.course import Course
from autograder.engine import grade as engine
from autograder.errors import RejectedUpload, SandboxError, UsageError
from autograder.verdicts import encode
from tests.reports.examples import result, small_class

Ended = tuple[int, str, str]


def test_a_table_on_stdout_and_progress_on_stderr(
    run: Callable[..., Ended], graded: Any, upload: Path, tmp_path: Path
) -> None:
    """Data goes to stdout, everything about the run to stderr."""
    graded["results"] = [one for one in small_class() if one.status != "grader_error"]
    code, out, err = run("grade", upload.parent, "-o", tmp_path / "out")
    assert code == 0
    assert "What went wrong most" in out
    assert "graded 10 of 10" in err
    assert "grades.csv" in err
    assert (tmp_path / "out" / "grades.csv").read_text().count("\n") == 11


def test_json_is_one_result_a_line_and_no_table(
    run: Callable[..., Ended], graded: Any, upload: Path, tmp_path: Path
) -> None:
    """What `--json` prints is what results/ holds, a line each."""
    graded["results"] = small_class()[:3]
    code, out, _ = run("grade", upload, "-o", tmp_path / "out", "--json")
    assert code == 0
    assert [json.loads(text)["submission"] for text in out.splitlines()] == [r.submission for r in graded["results"]]


def test_our_own_fault_ends_with_3(run: Callable[..., Ended], graded: Any, upload: Path, tmp_path: Path) -> None:
    """A submission that could not be graded is named, and the others have their marks."""
    graded["results"] = small_class()
    code, out, err = run("grade", upload, "-o", tmp_path / "out")
    assert code == 3
    assert "kim" in err.splitlines()[-1]
    assert "alice" in out


def test_an_interruption_keeps_what_is_done(
    run: Callable[..., Ended], graded: Any, upload: Path, tmp_path: Path
) -> None:
    """Ctrl-C ends with 130, after the table and grades.csv of what was graded."""
    graded["interrupted"] = True
    code, out, err = run("grade", upload, "-o", tmp_path / "out")
    assert code == 130
    assert "alice" in out
    assert "alice" in (tmp_path / "out" / "grades.csv").read_text()
    assert "1 of 1 are graded and kept; the same command goes on from there" in err


@pytest.mark.parametrize(
    ("error", "code"),
    [
        (UsageError("no course.toml: expected a file."), 2),
        (SandboxError("The canary escaped."), 3),
        (RejectedUpload("no."), 3),
        (KeyboardInterrupt(), 130),
        (ZeroDivisionError("a bug of ours"), 3),
    ],
)
def test_an_error_is_one_sentence(
    run: Callable[..., Ended], graded: Any, upload: Path, tmp_path: Path, error: BaseException, code: int
) -> None:
    """Whatever happens there is one line and the right exit code, never a traceback."""
    graded["raises"] = error
    ended, out, err = run("grade", upload, "-o", tmp_path / "out")
    assert (ended, out) == (code, "")
    assert len(err.strip().splitlines()) == 1
    assert "Traceback" not in err


def test_a_bug_of_ours_leaves_its_traceback_in_a_file(
    run: Callable[..., Ended], graded: Any, upload: Path, tmp_path: Path
) -> None:
    """The sentence names the file; --debug shows the traceback itself."""
    graded["raises"] = ZeroDivisionError("a bug of ours")
    _, _, err = run("grade", upload, "-o", tmp_path / "out")
    written = Path(err.strip().rsplit(" ", 1)[1].rstrip("."))
    assert "a bug of ours" in written.read_text()
    written.unlink()
    code, _, err = run("--debug", "grade", upload, "-o", tmp_path / "out")
    Path(err.strip().rsplit(" ", 1)[1].rstrip(".")).unlink()
    assert code == 3
    assert "ZeroDivisionError: a bug of ours" in err


def test_options_reach_the_engine(run: Callable[..., Ended], graded: Any, upload: Path, tmp_path: Path) -> None:
    """An option beats the course file; the course file beats the defaults."""
    course = tmp_path / "course.toml"
    assert run("init", course)[0] == 0
    options = ["--seed", 7, "--examples", 50, "--workers", 1, "--time-limit", 0.5, "--fresh", "--feedback", "hint"]
    assert run("grade", upload, "-o", tmp_path / "out", "--course", course, *options)[0] == 0
    asked = graded["settings"]
    assert (asked.seed, asked.examples, asked.workers, asked.time_limit) == (7, 50, 1, 0.5)
    assert (asked.fresh, asked.feedback, asked.min_confinement, asked.allow_unconfined) == (
        True,
        "hint",
        "seccomp",
        False,
    )
    assert (graded["course"].memory_mib, graded["course"].output_mib) == (512, 16)
    assert run("grade", upload, "-o", tmp_path / "out", "--memory", 256, "--output-limit", 2)[0] == 0
    assert (graded["course"].memory_mib, graded["course"].output_mib) == (256, 2)


def test_the_help_shows_the_defaults_that_hold(run: Callable[..., Ended]) -> None:
    """What the help calls a default is the default of a course."""
    shown = " ".join(run("grade", "--help")[1].split())
    course = Course()
    for option, value in {
        "--time-limit SECONDS": f"{course.time_limit:g}",
        "--memory MIB": course.memory_mib,
        "--output-limit MIB": course.output_mib,
        "--examples N": course.examples,
        "--feedback": course.feedback,
        "--min-confinement": course.min_confinement,
    }.items():
        assert shown.split(option)[1].split("[default: ")[1].startswith(f"the course's, or {value}]")


def test_only_grades_one_and_keeps_the_rest(
    run: Callable[..., Ended], graded: Any, upload: Path, tmp_path: Path
) -> None:
    """The table and grades.csv hold the stored results of the others too; an unknown id is bad usage."""
    (tmp_path / "out" / "results").mkdir(parents=True)
    (tmp_path / "out" / "results" / "bob.json").write_bytes(encode(result("bob")))
    (tmp_path / "out" / "results" / "odd.json").write_text("{")
    code, out, _ = run("grade", upload.parent, "-o", tmp_path / "out", "--only", "alice")
    assert code == 0
    assert [one.id for one in graded["submissions"]] == ["alice"]
    assert "bob" in out
    assert "bob" in (tmp_path / "out" / "grades.csv").read_text()
    code, _, err = run("grade", upload.parent, "-o", tmp_path / "out", "--only", "alcie")
    assert code == 2
    assert "did you mean alice" in err


def test_an_output_folder_that_is_a_file_is_bad_usage(run: Callable[..., Ended], upload: Path) -> None:
    """The reason and the way out stand in one line."""
    code, _, err = run("grade", upload, "-o", upload)
    assert code == 2
    assert str(upload) in err


def test_progress_lines_say_count_rate_and_time_left(capsys: pytest.CaptureFixture[str]) -> None:
    """Without a terminal there is a line now and then, and always the last one."""
    text = line(engine.Progress(50, 200, 10, "x"), 4.0)
    assert text == "graded 50 of 200, 10 unchanged, 10.0 a second, about 15 s left"
    now = [0.0]
    lines = Lines(sys.stderr, clock=lambda: now[0])
    for done in range(1, 101):
        now[0] += 0.2
        lines(engine.Progress(done, 100, 0, "x"))
    shown = capsys.readouterr().err.splitlines()
    assert 3 <= len(shown) <= 6
    assert shown[-1].startswith("graded 100 of 100")


class Terminal(io.StringIO):
    """Text that claims to be a terminal."""

    def isatty(self) -> bool:
        """Say that somebody is watching."""
        return True


def test_a_terminal_gets_a_bar_with_count_rate_and_name(monkeypatch: pytest.MonkeyPatch) -> None:
    """The bar stands on one line, is gone at the end, and prints hostile names as text."""
    for name, value in (("TERM", "xterm"), ("COLUMNS", "100")):
        monkeypatch.setenv(name, value)
    terminal = Terminal()
    with progress(terminal) as report:
        for done in range(1, 4):
            report(engine.Progress(done, 3, 1, "[red]evil\x1b[2J"))
    shown = terminal.getvalue()
    assert "3/3" in shown
    assert "/s" in shown
    assert "[red]evil" in shown
    assert "evil\x1b[2J" not in shown
    assert shown.count("\n") <= 1
