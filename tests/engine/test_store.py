"""The digest of the code covers what judges, and nothing that only shows."""

from __future__ import annotations

from pathlib import Path

from autograder.engine.store import SHOWING, _judges

ROOT = Path(__file__).resolve().parents[2] / "autograder"


def test_reports_exports_and_commands_change_no_fingerprint() -> None:
    """A better page is no reason to run a class again."""
    for name in ("reports/html.py", "exports/bundle.py", "commands/grade.py", "marking/merging.py", "cli.py"):
        assert not _judges(Path("autograder") / name)


def test_whatever_judges_is_covered() -> None:
    """Every room that can change a verdict counts, and every name that is left out is a room or a file."""
    for name in ("engine/judge.py", "stages/residual.py", "problems/draw.py", "sandbox/child.py", "intake/module.py"):
        assert _judges(Path("autograder") / name)
    assert {name for name in SHOWING if not (ROOT / name).exists()} <= {"marking", "desk", "exports", "audit"}
