"""`autograder audit` prints the table or JSON, and its exit code says whether the exam is sharp."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest
from click.testing import CliRunner

from autograder.audit import Audit
from autograder.audit.expectation import Cell
from autograder.audit.report import Row
from autograder.cli import cli, main


def run(monkeypatch: pytest.MonkeyPatch, found: Audit, *arguments: str) -> tuple[int, str]:
    """Run the command with this audit as what it finds."""
    monkeypatch.setattr("autograder.audit.audit", lambda *_, **__: found)
    result = CliRunner().invoke(cli, ["audit", *arguments], standalone_mode=False)
    assert result.exception is None
    return result.return_value, result.output


@pytest.mark.slow
def test_a_sharp_exam_ends_with_0(found: Audit, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is wrong: the counts, the matrix, the verdict."""
    code, output = run(monkeypatch, found)
    assert code == 0
    assert "The exam is sharp" in output


@pytest.mark.slow
def test_a_wrong_cell_ends_with_1(found: Audit, monkeypatch: pytest.MonkeyPatch) -> None:
    """One wrong cell is shown in full and costs the exit code."""
    row = Row("correct", "style_99.py", (Cell("residual", "passed", "failed"),))
    code, output = run(monkeypatch, replace(found, rows=(*found.rows, row)))
    assert code == 1
    assert "passed failed false alarm: a right answer loses points" in " ".join(output.split())
    code, output = run(monkeypatch, replace(found, rows=(row,)), "--json")
    assert (code, json.loads(output)["faults"]["false alarm"]) == (1, 1)


def test_a_family_that_does_not_exist_is_said(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The release would refuse it weeks later; no hour of auditing goes before the sentence."""
    monkeypatch.setattr("autograder.audit.audit", lambda *_, **__: pytest.fail("it was audited"))
    (tmp_path / "course.toml").write_text('[variants]\nfamilies = ["A", "Q"]\n')
    with pytest.raises(SystemExit) as end:
        main(["audit", "--course", str(tmp_path / "course.toml")])
    assert end.value.code == 2
    assert "There is no family 'Q'" in capsys.readouterr().err
