"""`autograder variant`: one student's numbers, from the ledger or drawn again."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from autograder.problems.exact import decimal
from tests.commands.released import files_of_the_course, options, variant_of

Ended = tuple[int, str, str]


@pytest.fixture
def files(run: Callable[..., Ended], tmp_path: Path) -> dict[str, Path]:
    """Release the class; return roster and secret."""
    files = files_of_the_course(tmp_path)
    assert run("release", *options(files), "-o", tmp_path / "release")[0] == 0
    return files


def test_it_shows_picture_data_and_solution(run: Callable[..., Ended], files: dict[str, Path], tmp_path: Path) -> None:
    """The ledger's numbers, drawn and listed, and the answers for staff."""
    variant = variant_of(tmp_path / "release", "s2")
    code, out, _ = run("variant", "S2", "--ledger", tmp_path / "release" / "staff" / "variants.csv")
    assert code == 0
    assert f"Variant {variant.identifier} of s2, family A" in out
    assert "x0 ---------> x1" in out
    assert f"row 0: edge 0 -> 1, measured {decimal(variant.exact.measurements[0])} m" in out
    assert "(" + ", ".join(map(decimal, variant.x1)) + ")" in out


def test_answers_can_be_left_out(run: Callable[..., Ended], files: dict[str, Path], tmp_path: Path) -> None:
    """What a student may see holds neither x1 nor the letter."""
    variant = variant_of(tmp_path / "release", "s2")
    _, out, _ = run("variant", "s2", "--no-answers", "--ledger", tmp_path / "release" / "staff" / "variants.csv")
    assert ", ".join(map(decimal, variant.x1)) not in out
    assert "conclusion" not in out


def test_viva_and_by_hand(run: Callable[..., Ended], files: dict[str, Path], tmp_path: Path) -> None:
    """Three questions with answers, and the page in whole numbers, on request."""
    ledger = tmp_path / "release" / "staff" / "variants.csv"
    _, out, _ = run("variant", "s1", "--ledger", ledger, "--viva", "--by-hand")
    assert out.count("   Answer: ") == 3
    assert "\n3. " in out
    assert "## 6. Check H Δx = −b" in out
    assert run("variant", "s1", "--ledger", ledger)[1].count("Answer") == 0


def test_without_a_ledger_it_is_drawn_again(run: Callable[..., Ended], files: dict[str, Path], tmp_path: Path) -> None:
    """Roster, term and secret give the same text as the ledger."""
    recorded = run("variant", "s3", "--ledger", tmp_path / "release" / "staff" / "variants.csv")
    assert run("variant", "s3", *options(files)) == recorded


def test_who_is_not_there_is_said(run: Callable[..., Ended], files: dict[str, Path], tmp_path: Path) -> None:
    """An unknown student, and a call that says nothing about the class, end with 2 and a sentence."""
    code, _, err = run("variant", "s22", "--ledger", tmp_path / "release" / "staff" / "variants.csv")
    assert code == 2
    assert "has no student 's22' among its 3; did you mean s2?" in err
    code, _, err = run("variant", "s1")
    assert code == 2
    assert "Whose numbers? Give --ledger FILE" in err
    code, _, err = run("variant", "s1", "--roster", files["--roster"], "--term", "2026S")
    assert code == 2
    assert "--secret-file is missing" in err
