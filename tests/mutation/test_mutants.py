"""Mutants of the reference are many, different, and whole modules; `make mutants` judges them."""

from __future__ import annotations

from pathlib import Path

import pytest

import reference_solution

pytest.importorskip("cosmic_ray", reason="what mutates is installed for `make mutants` only")

from tests.mutation.__main__ import EQUIVALENT, table
from tests.mutation.mutants import Mutant, mutants

SOURCE = (Path(reference_solution.__path__[0]) / "slam1d.py").read_text("utf-8")


def test_every_function_of_the_reference_is_mutated() -> None:
    """More than a hundred mutants, all different, each one line away from the reference; nothing is listed in vain."""
    found = list(mutants(SOURCE))
    assert len({mutant.text for mutant in found}) == len(found) > 100
    assert all(mutant.old and mutant.new and mutant.old != mutant.new for mutant in found)
    assert {"b = J.T * omega @ f", "b = J.copy() @ omega @ f", "return b, H"} <= {mutant.new for mutant in found}
    assert set(EQUIVALENT) <= {mutant.new for mutant in found}


def test_a_survivor_without_a_reason_is_a_hole(capsys: pytest.CaptureFixture[str]) -> None:
    """The table ends with 1 for a survivor that nobody explains, and for an explanation that is not needed."""
    explained = [Mutant("ListTurned", "", line, "") for line in EQUIVALENT]
    hole = Mutant("ReplaceBinaryOperator_Sub_Add", "a - b", "a + b", "")
    assert table(explained, [""] * len(explained)) == 0
    assert table([*explained, hole], [""] * len(explained) + ["residual"]) == 0
    assert table([*explained, hole], [""] * (len(explained) + 1)) == 1
    assert "NOT EXPLAINED" in capsys.readouterr().out
    assert table(explained, ["jacobian"] * len(explained)) == 1
