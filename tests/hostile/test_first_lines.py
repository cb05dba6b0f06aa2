"""The corpus is complete and honest about itself: every attack has a case, every case a verdict."""

from __future__ import annotations

import pytest

from autograder.intake.submission import collect
from tests.hostile import corpus, uploads
from tests.hostile.corpus import SECTIONS, Case

CASES = corpus.cases()
ATTACKS = range(1, 99)  # of the list that the security page quotes


def test_every_attack_has_a_case() -> None:
    """Each number of the list is a specimen or an upload that is built."""
    numbers = {case.number for case in CASES} | {upload.number for upload in uploads.uploads()}
    assert set(ATTACKS) - numbers == set()


def test_every_section_has_cases() -> None:
    """No kind of attack is missing."""
    assert {case.section for case in CASES} == set(SECTIONS)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_a_file_is_named_for_its_number(case: Case) -> None:
    """The number in the name is the one in the sentence, and something is left to fail."""
    assert case.name.split("_")[:2] == ["case", f"{case.number:02}"]
    assert case.honest() < 100
    if case.escapes:
        assert case.attempts, "a case that pays when it gets through has attempts"


def test_the_uploads_are_the_same_every_time() -> None:
    """Building them again gives the same bytes."""
    first, second = ([upload.data for upload in uploads.uploads()] for _ in range(2))
    assert first == second


def test_the_misleading_member_leads_its_group() -> None:
    """Its digest is small, so that the grader asks it first; after an edit its last comment needs a new number."""
    (found,) = collect([corpus.folder() / "case_106_mislead_its_group.py"])
    assert found.digest.startswith("0000"), "try other numbers in the last comment until the digest begins with 0000"
