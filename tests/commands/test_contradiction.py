"""Uploads carry their variants: a run that would judge the class on others stops before anything is written."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.commands.released import files_of_the_course, ledger_of, options
from tests.intake.making import cell, notebook
from tests.reports.examples import result

Ended = tuple[int, str, str]
STUDENTS = ("s1", "s2", "s3")


@pytest.fixture
def files(run: Callable[..., Ended], graded: dict[str, Any], tmp_path: Path) -> dict[str, Path]:
    """Release family B, which is not the default, to a class, and let everybody hand in the own notebook."""
    files = files_of_the_course(tmp_path)
    (tmp_path / "course.toml").write_text('[variants]\nfamilies = ["B"]\n')
    given = options(files, course=tmp_path / "course.toml")
    assert run("release", *given, "-o", tmp_path / "release")[0] == 0
    (tmp_path / "uploads").mkdir()
    for variant in ledger_of(tmp_path / "release"):
        data = notebook(cell(), metadata={"slam1d": {"variant": variant.identifier}})
        (tmp_path / "uploads" / f"{variant.student_id}.ipynb").write_bytes(data)
    graded["results"] = [result(name, student_id=name) for name in STUDENTS]
    return files


def _mistakes(files: dict[str, Path], folder: Path) -> dict[str, list[object]]:
    (folder / "other.txt").write_text("fedcba9876543210fedcba9876543210")
    course = {"course": folder / "course.toml"}
    return {
        "wrong secret": options({**files, "--secret-file": folder / "other.txt"}, **course),
        "another term": [*options(files, **course), "--term", "2027S"],
        "forgotten course": options(files),
        "forgotten ledger": ["--roster", files["--roster"], "--course", folder / "course.toml"],
        "nothing at all": [],
    }


MISTAKES = ("wrong secret", "another term", "forgotten course", "forgotten ledger", "nothing at all")


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_class_is_not_judged_on_variants_that_nobody_was_given(
    mistake: str, run: Callable[..., Ended], graded: dict[str, Any], files: dict[str, Path], tmp_path: Path
) -> None:
    """One sentence names the upload, the variant and what to give; nothing is written. --anyway goes on and says so."""
    command = ("grade", tmp_path / "uploads", "-o", tmp_path / "out", *_mistakes(files, tmp_path)[mistake])
    code, _, err = run(*command)
    assert (code, "drew" in err) == (2, mistake in MISTAKES[:3]), err
    assert "of 3 uploads with numbers of their own carry a variant that" in err
    assert "(the first is s1, " in err
    assert "nothing was graded. Give the --ledger of the release, or its --roster, --term, --secret-file" in err
    assert "submissions" not in graded
    assert not (tmp_path / "out").exists()
    code, _, err = run(*command, "--anyway")
    assert code == 0
    assert "they are judged on other numbers." in err


def test_the_right_command_says_nothing_of_it(
    run: Callable[..., Ended], graded: dict[str, Any], files: dict[str, Path], tmp_path: Path
) -> None:
    """Neither with the ledger nor where the variants are drawn again; one copied notebook of three is a note."""
    uploads = tmp_path / "uploads"
    ledger = tmp_path / "release/staff/variants.csv"
    for more in (("--ledger", ledger), options(files, course=tmp_path / "course.toml")):
        code, _, err = run("grade", uploads, "-o", tmp_path / "out", *more)
        assert code == 0
        assert "variant" not in err
    data = notebook(cell(), metadata={"slam1d": {"variant": "B-0000000000000000"}})
    (uploads / "s1.ipynb").write_bytes(data)
    code, _, err = run("grade", uploads, "-o", tmp_path / "out", "--ledger", ledger)
    assert code == 0
    assert "1 of 3 uploads with numbers of their own carry a variant that nobody of this class was given" in err
