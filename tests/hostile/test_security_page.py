"""The security page names every attack of the corpus, and nothing that is not there."""

from __future__ import annotations

import re
from pathlib import Path

from autograder.sandbox.seccomp import POLICY
from tests.hostile import corpus, uploads

PAGE = (Path(__file__).resolve().parents[2] / ".github" / "SECURITY.md").read_text("utf-8")


def numbers() -> set[int]:
    """Read the numbers in the first column of the table of threats."""
    found: set[int] = set()
    for cell in re.findall(r"^\| ([\d, -]+) \|", PAGE, flags=re.MULTILINE):
        for part in cell.split(", "):
            first, _, last = part.partition("-")
            found |= set(range(int(first), int(last or first) + 1))
    return found


def test_the_table_names_every_attack() -> None:
    """Each number of a specimen or an upload has a line with what stops it, and each line has a case."""
    cases = {case.number for case in corpus.cases()} | {upload.number for upload in uploads.uploads()}
    assert numbers() == cases


def test_the_count_of_open_calls_is_true() -> None:
    """The page says how many system calls stay open."""
    assert f"About {len(POLICY)} system calls" in PAGE


def test_the_measured_count_is_that_of_the_corpus() -> None:
    """An attempt that is added is measured and written down."""
    assert f"of {sum(len(case.attempts) for case in corpus.cases())} single attempts" in PAGE


def test_every_path_that_is_named_exists() -> None:
    """Files and folders of ours that the page names are there."""
    root = Path(__file__).resolve().parents[2]
    named = re.findall(r"`((?:autograder|tests)/[\w./]+|Dockerfile)`", PAGE)
    assert named
    assert [name for name in named if not (root / name).exists()] == []
