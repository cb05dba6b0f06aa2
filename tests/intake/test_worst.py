"""One bad file costs its own row and at most two seconds: what reads an upload is linear in it, and bounded."""

from __future__ import annotations

import sys
import time
from pathlib import Path

import pytest

from autograder.intake.submission import collect
from autograder.intake.written import written_answers
from tests.intake.making import CODE
from tests.intake.worst import WORST

_SECONDS = 2.0 if sys.gettrace() is None else 6.0  # of computing; what measures coverage is not part of it


@pytest.mark.parametrize("kind", WORST)
def test_the_worst_upload_of_each_kind_costs_two_seconds_at_most(tmp_path: Path, kind: str) -> None:
    """Attachments, pictures, cells, keys, nesting, digits, escapes, encodings, tables of contents of archives."""
    suffix, make = WORST[kind]
    (tmp_path / f"worst{suffix}").write_bytes(make())
    (tmp_path / "zoe.py").write_text(CODE)
    began = time.process_time()
    worst, zoe = collect([tmp_path])
    written_answers(worst.markdown)
    assert time.process_time() - began < _SECONDS
    assert (worst.id, zoe.id, zoe.rejection) == ("worst", "zoe", "")


@pytest.mark.parametrize("suffix", [".txt", ""])
@pytest.mark.parametrize("kind", ["attachments", "escapes", "nesting"])
def test_nor_does_it_cost_more_under_another_name(tmp_path: Path, kind: str, suffix: str) -> None:
    """What is inside is looked at, and that is bounded too."""
    (tmp_path / f"worst{suffix}").write_bytes(WORST[kind][1]())
    (tmp_path / "zoe.py").write_text(CODE)
    began = time.process_time()
    found = collect([tmp_path])
    assert time.process_time() - began < _SECONDS
    assert [each.id for each in found] == ["worst", "zoe"]
