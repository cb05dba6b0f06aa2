"""The command line in this process, and a class made by hand in the place of the engine."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from autograder import cli
from autograder.engine import grade as engine
from autograder.engine.store import RunRecord, Store
from tests.reports.examples import result

Ended = tuple[int, str, str]


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Callable[..., Ended]:
    """Run the command line in this process: exit code, stdout, stderr."""

    def run(*arguments: object) -> Ended:
        with pytest.raises(SystemExit) as end:
            cli.main([str(argument) for argument in arguments])
        out, err = capsys.readouterr()
        assert isinstance(end.value.code, int)
        return end.value.code, out, err

    return run


@pytest.fixture
def graded(monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """Put a class that was made by hand in the place of the engine; see what the engine is asked for."""
    asked: dict[str, Any] = {"results": [result("alice")], "interrupted": False, "raises": None}

    def grade(
        submissions: Any,
        course: Any,
        settings: Any,
        out: Path,
        on_progress: Any,
        assigned: Any = None,
        exam: Any = None,
        server: Any = None,
    ) -> engine.Run:
        asked.update(submissions=submissions, course=course, settings=settings, assigned=assigned, exam=exam)
        if asked["raises"]:
            raise asked["raises"]
        for number, one in enumerate(asked["results"], 1):
            Store(out).save(one)
            on_progress(engine.Progress(number, len(asked["results"]), 0, one.submission))
        record = RunRecord(
            seed=settings.seed,
            examples=settings.examples,
            exam="",
            confinement="full",
            versions={},
            settings={"feedback": settings.feedback},
            submissions=len(submissions),
            graded_now=1,
            reused=0,
            interrupted=asked["interrupted"],
            seconds=0.1,
        )
        Store(out).save_record(record)
        return engine.Run(tuple(asked["results"]), record, asked["interrupted"])

    monkeypatch.setattr(engine, "grade", grade)
    return asked


@pytest.fixture
def upload(tmp_path: Path) -> Path:
    """Write one small submission."""
    path = tmp_path / "uploads" / "alice.py"
    path.parent.mkdir()
    path.write_text("def residual(x, graph):\n    return []\n")
    return path
