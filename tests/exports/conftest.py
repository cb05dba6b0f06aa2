"""A graded folder and the command line in this process."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from autograder import cli
from autograder.reports.folder import write_reports
from autograder.verdicts import Result, encode

Ended = tuple[int, str, str]


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Callable[..., Ended]:
    """Run the command line: exit code, stdout, stderr."""

    def run(*arguments: object) -> Ended:
        with pytest.raises(SystemExit) as end:
            cli.main([str(argument) for argument in arguments])
        out, err = capsys.readouterr()
        assert isinstance(end.value.code, int)
        return end.value.code, out, err

    return run


@pytest.fixture
def graded(tmp_path: Path) -> Callable[[Sequence[Result]], Path]:
    """Write results as `grade` does, and return the folder."""

    def write(results: Sequence[Result]) -> Path:
        out = tmp_path / "graded"
        (out / "results").mkdir(parents=True)
        for result in results:
            (out / "results" / f"{result.submission}.json").write_bytes(encode(result))
        (out / "run.json").write_text(json.dumps({"settings": {"feedback": "full"}}), encoding="utf-8")
        write_reports(results, out, {})
        return out

    return write
