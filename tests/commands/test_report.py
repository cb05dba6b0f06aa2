"""`autograder report`: every report again from stored results."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from autograder.engine import grade as engine
from autograder.verdicts import encode
from tests.reports.examples import result, small_class

Ended = tuple[int, str, str]


def test_report_writes_everything_again_without_running_code(
    run: Callable[..., Ended], graded: Any, upload: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Pages and tables come from stored results; the feedback policy of the run is kept unless another is given."""
    graded["results"] = small_class()
    out = tmp_path / "out"
    run("grade", upload, "-o", out, "--feedback", "hint")
    before = {path.relative_to(out): path.read_bytes() for path in out.rglob("*.html")}
    assert len(before) == 12
    for path in before:
        (out / path).unlink()
    monkeypatch.setattr(engine, "grade", None)
    code, text, _ = run("report", out)
    assert code == 0
    assert "What went wrong most" in text
    assert {path.relative_to(out): path.read_bytes() for path in out.rglob("*.html")} == before
    run("report", out, "--feedback", "full")
    assert {path.relative_to(out): path.read_bytes() for path in out.rglob("*.html")} != before


def test_a_forum_post_names_nobody(run: Callable[..., Ended], graded: Any, upload: Path, tmp_path: Path) -> None:
    """`report --format md` holds means and shared mistakes, and no name of a student."""
    graded["results"] = small_class()
    run("grade", upload, "-o", tmp_path / "out")
    code, text, _ = run("report", tmp_path / "out", "--format", "md")
    assert code == 0
    assert "2 times in `jacobian`: loop sign flipped" in text
    assert not [one.submission for one in small_class() if one.submission in text]


def test_report_of_no_run_is_bad_usage(run: Callable[..., Ended], tmp_path: Path) -> None:
    """A folder without results is named, with what was expected."""
    code, _, err = run("report", tmp_path)
    assert code == 2
    assert str(tmp_path) in err


def test_report_leaves_out_what_it_cannot_read(
    run: Callable[..., Ended], graded: Any, upload: Path, tmp_path: Path
) -> None:
    """A damaged or renamed result is no reason to stop, and cannot write outside of the folder."""
    run("grade", upload, "-o", tmp_path / "out")
    (tmp_path / "out" / "results" / "broken.json").write_text('{"submission": 3')
    (tmp_path / "out" / "results" / "evil.json").write_bytes(encode(result("../../evil")))
    code, text, err = run("report", tmp_path / "out")
    assert code == 0
    assert "broken.json" in err
    assert "evil" not in text
    assert not (tmp_path / "evil.html").exists()
