"""Drawing cases leaves nothing in the folder of the user."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
DRAW = """
from autograder.diagnosis.witness import smallest_witness
from autograder.problems.draw import draw_ladder
from autograder.stages.catalogue import stage
draw_ladder(stage("residual").ladder, 0, 5)
smallest_witness("graphs", lambda case: True)
"""


@pytest.mark.slow
def test_drawing_and_shrinking_write_nothing(tmp_path: Path) -> None:
    """A new process in an empty folder leaves it empty."""
    environment = {"PYTHONPATH": str(ROOT), "PATH": "/usr/bin:/bin"}
    subprocess.run([sys.executable, "-c", DRAW], cwd=tmp_path, env=environment, check=True)
    assert list(tmp_path.iterdir()) == []
