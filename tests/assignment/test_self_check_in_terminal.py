"""`python self_check.py` in a folder as a student has it: one sentence for whatever cannot be checked."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

FOLDER = Path(__file__).parents[2] / "assignment"
STUB = (FOLDER / "slam1d.py").read_text(encoding="utf-8")


def in_terminal(folder, *arguments, without=()):
    """Run `python self_check.py` in a folder as a student has it; return code, output and error text."""
    for name in {"self_check.py", "posegraph.py"} - set(without):
        shutil.copyfile(FOLDER / name, folder / name)
    command = [sys.executable, "self_check.py", *arguments]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, encoding="utf-8", check=False)
    return done.returncode, done.stdout, done.stderr


def test_the_terminal_says_what_it_checks_and_how_to_go_on(tmp_path):
    """The first line names the file; unfinished functions of a file are not run as cells, but saved."""
    (tmp_path / "slam1d.py").write_bytes(b"\xef\xbb\xbf" + STUB.replace("\n", "\r\n").encode())  # as on Windows
    code, shown, error = in_terminal(tmp_path)
    assert (code, error) == (0, "")
    assert shown.startswith("Checking slam1d.py (working in the notebook? Run its last cell, check_all, instead).\n")
    open_work = shown.partition("\n")[2].partition("What")[0].splitlines()
    assert open_work[0] == "TODO  residual: not finished yet: write it, save it, check again."
    assert open_work[5] == "TODO  second_step: gauss_newton_step is not finished yet: write it, save it, check again."
    assert open_work[7:] == [f"TODO  {name}: it is still None." for name in ("conclusion", "written_2", "written_3")]


@pytest.mark.parametrize(
    ("name", "text", "without", "message"),
    [
        (
            "slam1d.ipynb",
            b"{}",
            (),
            r"This checks modules; in the notebook, run its last cell, check_all\(globals\(\)\)\.",
        ),
        ("none.py", None, (), r"none\.py: FileNotFoundError: .*"),
        ("slam1d.py", b"f = 1\nx = (2 +\n", (), r"slam1d\.py: SyntaxError: .*\(slam1d\.py, line 2\)"),
        ("slam1d.py", b"f = '\xe9'\n", (), r"slam1d\.py: SyntaxError: .*utf-8.*"),
        (
            "slam1d.py",
            STUB.encode() + b"\n\nprint(residual(my_start, my_graph))\n",
            (),
            r"slam1d\.py, line 266: NotImplementedError: residual is not finished yet: .*\.",
        ),
        ("slam1d.py", b"exit()\n", (), r"slam1d\.py, line 1: SystemExit: None"),
        ("slam1d.py", STUB.encode(), ("posegraph.py",), r"posegraph\.py must lie beside self_check\.py\."),
    ],
    ids=["notebook", "missing", "syntax", "latin-1", "top-level", "exit", "posegraph"],
)
def test_a_file_that_cannot_be_checked_gives_one_sentence(tmp_path, name, text, without, message):
    """No traceback: what came, on which line, and exit code 1."""
    if text is not None:
        (tmp_path / name).write_bytes(text)
    code, _shown, error = in_terminal(tmp_path, name, without=without)
    assert code == 1
    assert re.fullmatch(message, error.strip())
