"""The command line: it answers at once, teaches by example, and ends with the contract's exit codes."""

from __future__ import annotations

import json
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from autograder import cli
from autograder.commands._progress import Lines, line
from autograder.engine import grade as engine
from autograder.errors import RejectedUpload, SandboxError, UsageError
from autograder.verdicts import encode
from tests.reports.examples import result, small_class

HEAVY = ("numpy", "hypothesis", "rich", "nbformat", "jinja2", "msgspec", "multiprocessing")
Ended = tuple[int, str, str]


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Callable[..., Ended]:
    """Run the command line in this process: exit code, stdout, stderr."""

    def run(*arguments: object) -> Ended:
        with pytest.raises(SystemExit) as end:
            cli.main([str(argument) for argument in arguments])
        out, err = capsys.readouterr()
        assert isinstance(end.value.code, int)
        return end.value.code, out, err

    return run


@pytest.fixture
def graded(monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """Put a class that was made by hand in the place of the engine; see what the engine is asked for."""
    asked: dict[str, Any] = {"results": [result("alice")], "interrupted": False, "raises": None}

    def grade(submissions: Any, course: Any, settings: Any, out: Path, on_progress: Any) -> engine.Run:
        asked.update(submissions=submissions, course=course, settings=settings)
        if asked["raises"]:
            raise asked["raises"]
        for number, one in enumerate(asked["results"], 1):
            on_progress(engine.Progress(number, len(asked["results"]), 0, one.submission))
        record: Any = SimpleNamespace()
        return engine.Run(tuple(asked["results"]), record, asked["interrupted"])

    monkeypatch.setattr(engine, "grade", grade)
    return asked


@pytest.fixture
def upload(tmp_path: Path) -> Path:
    """Write one small submission."""
    path = tmp_path / "uploads" / "alice.py"
    path.parent.mkdir()
    path.write_text("def residual(x, graph):\n    return []\n")
    return path


def test_help_imports_nothing_heavy() -> None:
    """`autograder --help` answers at once: what costs time is imported by the command that needs it."""
    code = (
        "import sys\nfrom autograder import cli\n"
        "try:\n    cli.main(['--help'])\nexcept SystemExit:\n"
        f"    print([name for name in {HEAVY} if name in sys.modules])"
    )
    shown = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert shown.stdout.splitlines()[-1] == "[]"


def test_help_is_fast() -> None:
    """The best of five starts is under 150 ms, or twice a bare interpreter with click on a slow machine."""

    def seconds(*command: str) -> float:
        best = 10.0
        for _ in range(5):
            start = time.perf_counter()
            subprocess.run([sys.executable, *command], capture_output=True, check=True)
            best = min(best, time.perf_counter() - start)
        return best

    assert seconds("-m", "autograder", "--help") < max(0.150, 2 * seconds("-c", "import click"))


def test_help_shows_commands_that_work(run: Callable[..., Ended]) -> None:
    """Every line of the help that begins with `autograder` names a command and options that exist."""
    code, out, _ = run("--help")
    assert code == 0
    commands = cli.cli.list_commands(None)  # type: ignore[arg-type]
    assert commands[:2] == ["demo", "init"]
    for name in commands:
        code, text, _ = run(name, "--help")
        assert code == 0
        out += text
        examples = [
            li.split("|")[0].split("  ")[0] for li in map(str.strip, text.splitlines()) if li.startswith("autograder")
        ]
        assert any(example.split()[1] == name for example in examples), f"{name} --help shows no example"
    for example in (li.strip() for li in out.splitlines() if li.strip().startswith("autograder ")):
        assert example.split()[1].split(" ")[0] in commands


def test_no_arguments_show_the_help(run: Callable[..., Ended]) -> None:
    """A bare `autograder` is a question, not a mistake."""
    code, out, err = run()
    assert (code, err) == (0, "")
    assert "autograder grade" in out


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["grad"], ["'grad'", "demo, init, grade"]),
        (["grade"], ["PATH", "autograder grade --help"]),
        (["grade", "x"], ["-o", "autograder grade --help"]),
        (["grade", "x", "-o", "y", "--sed", "1"], ["--sed", "--seed"]),
        (["grade", "x", "-o", "y", "--workers", "0"], ["--workers", "x>=1"]),
        (["grade", "x", "-o", "y", "--time-limit", "zero"], ["--time-limit", "zero"]),
        (["grade", "x", "-o", "y", "--feedback", "all"], ["all", "full", "hint", "score"]),
        (["grade", "does/not/exist", "-o", "y"], ["does/not/exist"]),
    ],
)
def test_bad_usage_is_one_line(
    run: Callable[..., Ended], tmp_path: Path, monkeypatch: Any, arguments: Any, words: Any
) -> None:
    """Exit 2, and one line that says what came, what was expected and what to try."""
    monkeypatch.chdir(tmp_path)
    code, out, err = run(*arguments)
    assert (code, out) == (2, "")
    assert len(err.splitlines()) == 1
    assert all(word in err for word in words), err


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
    assert "goes on from there" in err or "goes on from here" in err


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
    with pytest.raises(ZeroDivisionError):
        cli.main(["--debug", "grade", str(upload), "-o", str(tmp_path / "out")])


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


def test_init_writes_a_course_file_once(run: Callable[..., Ended], tmp_path: Path) -> None:
    """A course file that somebody edited is never overwritten."""
    code, out, _ = run("init", tmp_path / "course.toml")
    assert code == 0
    assert "--course" in out
    assert run("init", tmp_path / "course.toml")[0] == 2


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


def test_the_module_and_the_script_are_the_same() -> None:
    """`python -m autograder --version` answers."""
    shown = subprocess.run(
        [sys.executable, "-m", "autograder", "--version"], capture_output=True, text=True, check=True
    )
    assert shown.stdout.startswith("autograder, version ")


def test_a_reader_that_leaves_early_is_no_error(tmp_path: Path) -> None:
    """`autograder grade --help | head -1` ends quietly."""
    code = f"{sys.executable} -m autograder grade --help | head -1"
    shown = subprocess.run(["bash", "-c", code], capture_output=True, text=True, check=True)
    assert shown.stderr == ""
