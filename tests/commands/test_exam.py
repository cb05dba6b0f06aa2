"""`autograder exam` and `grade --exam`: an exam is drawn into a file, said, taken, kept and never mixed."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from tests.engine.conftest import REFERENCE

Ended = tuple[int, str, str]


@pytest.fixture
def uploads(tmp_path: Path) -> Path:
    """Two submissions."""
    folder = tmp_path / "uploads"
    folder.mkdir()
    for name in ("ada", "bob"):
        (folder / f"{name}.py").write_text(REFERENCE)
    return folder


def test_an_exam_is_drawn_and_said(run: Callable[..., Ended], tmp_path: Path) -> None:
    """What is printed at the draw is what the file says later."""
    file = tmp_path / "midterm.exam"
    code, out, err = run("exam", "-o", file, "--seed", 3, "--examples", 4)
    assert (code, "--exam" in err) == (0, True)
    assert "seed 3, 4 cases" in out
    assert "hypothesis" in out
    assert run("exam", file) == (0, out, "")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ((), "Expected one of two"),
        (("a.exam", "-o", "b.exam"), "Expected one of two"),
        (("a.exam", "--seed", "3"), "drawn already"),
        (("nowhere.exam",), "cannot be read as an exam"),
    ],
)
def test_wrong_use_is_one_sentence(
    run: Callable[..., Ended], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, words: tuple[str, ...], said: str
) -> None:
    """Exit code 2, and what was expected."""
    monkeypatch.chdir(tmp_path)
    code, out, err = run("exam", *words)
    assert (code, out) == (2, "")
    assert said in err


def test_a_folder_keeps_its_exam_whatever_is_forgotten(
    run: Callable[..., Ended], uploads: Path, tmp_path: Path
) -> None:
    """A second run without --seed and --examples takes the exam of the first, and runs nothing again."""
    out = tmp_path / "out"
    assert run("grade", uploads, "-o", out, "--seed", 3, "--examples", 4)[0] == 0
    exam = (out / "exam").read_bytes()
    code, _, err = run("grade", uploads, "-o", out)
    assert (code, "2 unchanged" in err) == (0, True)
    assert (out / "exam").read_bytes() == exam
    assert "seed 3, 4 cases" in run("exam", out / "exam")[1]


def test_another_exam_means_everybody_again(run: Callable[..., Ended], uploads: Path, tmp_path: Path) -> None:
    """It is announced; one of the class alone is refused, and nothing that was graded is touched by that."""
    out = tmp_path / "out"
    run("grade", uploads, "-o", out, "--examples", 4)
    before = {path.name: path.read_bytes() for path in (out / "results").iterdir()}
    code, _, err = run("grade", uploads, "-o", out, "--only", "ada", "--seed", 5)
    assert (code, "--only" in err) == (2, True)
    assert {path.name: path.read_bytes() for path in (out / "results").iterdir()} == before
    run("exam", "-o", tmp_path / "x.exam", "--seed", 5, "--examples", 4)
    code, _, err = run("grade", uploads, "-o", out, "--exam", tmp_path / "x.exam")
    assert code == 0
    assert "everybody is graded again" in err
    assert "unchanged" not in err
    assert run("grade", uploads, "-o", out, "--exam", tmp_path / "x.exam", "--seed", 6)[0] == 2
