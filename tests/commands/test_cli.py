"""The command line: it answers at once, teaches by example, and ends with the contract's exit codes."""

from __future__ import annotations

import errno
import re
import resource
import shlex
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import click
import pytest

from autograder import cli

HEAVY = ("numpy", "hypothesis", "rich", "nbformat", "jinja2", "msgspec", "multiprocessing")
Ended = tuple[int, str, str]


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
    """The best of five starts takes under 150 ms of computing, or thrice a bare interpreter where that is slow."""

    def seconds(*command: str) -> float:
        costs = []
        for _ in range(5):
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            subprocess.run([sys.executable, *command], capture_output=True, check=True)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            costs.append(after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime)
        return min(costs)

    assert seconds("-m", "autograder", "--help") < max(0.150, 3 * seconds("-c", "import click"))


def test_help_shows_commands_that_work(run: Callable[..., Ended]) -> None:
    """Every line of the help that begins with `autograder` names a command and options that exist."""
    code, out, _ = run("--help")
    assert code == 0
    commands = cli.cli.list_commands(None)
    assert commands[:3] == ["demo", "doctor", "init"]
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
        (["grad"], ["'grad'", "demo, doctor, init"]),
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


def test_init_writes_a_course_file_once(run: Callable[..., Ended], tmp_path: Path) -> None:
    """A course file that somebody edited is never overwritten."""
    code, out, _ = run("init", tmp_path / "course.toml")
    assert code == 0
    assert "--course" in out
    assert run("init", tmp_path / "course.toml")[0] == 2


def test_the_module_and_the_script_are_the_same() -> None:
    """`python -m autograder --version` answers."""
    shown = subprocess.run(
        [sys.executable, "-m", "autograder", "--version"], capture_output=True, text=True, check=True
    )
    assert shown.stdout.startswith("autograder, version ")


def test_a_reader_that_leaves_early_is_no_error(tmp_path: Path) -> None:
    """`autograder grade --help | head -1` ends quietly."""
    code = f"{shlex.quote(sys.executable)} -m autograder grade --help | head -1"
    shown = subprocess.run(["bash", "-c", code], capture_output=True, text=True, check=True)
    assert shown.stderr == ""


def test_python_without_docstrings_is_refused() -> None:
    """Hints, names and help live in docstrings: with -OO one sentence says so; -O is as good as none."""
    command = ("-m", "autograder", "grade", "--help")
    shown = subprocess.run([sys.executable, "-OO", *command], capture_output=True, text=True, check=False)
    assert (shown.returncode, shown.stdout) == (2, "")
    assert re.fullmatch(r"autograder: Python runs with -OO, .*\n", shown.stderr)
    assert subprocess.run([sys.executable, "-O", *command], capture_output=True, check=False).returncode == 0


@pytest.mark.parametrize(
    ("error", "code", "words"),
    [
        (click.Abort(), 130, "Interrupted"),
        (KeyboardInterrupt(), 130, "Interrupted"),
        (BrokenPipeError(errno.EPIPE, "Broken pipe"), 3, "no fault of a student"),
        (AssertionError("no"), 3, "no fault of a student"),
        (click.ClickException("what came"), 2, "what came"),
        (OSError(errno.EMFILE, "Too many open files"), 3, "`ulimit -n`"),
        (BlockingIOError(errno.EAGAIN, "Resource temporarily unavailable"), 3, "too few processes"),
        (RuntimeError("can't start new thread"), 3, "too few processes"),
        (MemoryError(), 3, "too little memory"),
        (OSError(errno.ENOSPC, "No space left on device"), 2, "could not be written"),
    ],
    ids=repr,
)
def test_only_a_defect_of_the_exam_ends_with_1(
    run: Callable[..., Ended], monkeypatch: pytest.MonkeyPatch, error: BaseException, code: int, words: str
) -> None:
    """Whatever is raised inside a command is one line and another exit code, with --debug too."""

    def fail(*_: object, **__: object) -> None:
        raise error

    monkeypatch.setattr("autograder.commands.init.command.invoke", fail)
    ended, out, err = run("init", "x.toml")
    assert (ended, out, len(err.splitlines())) == (code, "", 1)
    assert words in err
    assert run("--debug", "init", "x.toml")[0] == code


def test_the_list_of_commands_says_whole_sentences(run: Callable[..., Ended]) -> None:
    """A first sentence that is too long for a line goes on in the next; nothing ends in dots."""
    listed = run("--help")[1].split("Commands:")[1]
    assert "..." not in listed
    assert all(name in listed for name in cli.cli.list_commands(None))
