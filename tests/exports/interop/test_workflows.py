"""The example workflows are YAML, and what GitHub reads in them is what was meant."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.exports.interop.conftest import run
from tests.exports.interop.test_otter import SYSTEM
from tests.exports.test_examples import WORKFLOWS, steps

READ = "import json, sys, yaml; json.dump(yaml.load(open(sys.argv[1]), yaml.BaseLoader), sys.stdout)"


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.stem)
def test_a_workflow_is_yaml(environment: Callable[..., Path], path: Path, tmp_path: Path) -> None:
    """It has events and one job, and its scripts are those that the tests run."""
    python = environment(SYSTEM, "numpy>=2.2", "ipykernel") / "python"
    found = json.loads(run([python, "-c", READ, path], tmp_path))
    assert found["on"]
    (job,) = found["jobs"].values()
    assert [step["run"].strip() for step in job["steps"] if "run" in step] == [each.strip() for each in steps(path)]
