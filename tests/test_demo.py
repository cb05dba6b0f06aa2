"""The demo tells the whole story: the homework, a class, its marks, a mistake and where to look."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest

from autograder import cli
from autograder.stages.catalogue import all_stages
from autograder.verdicts import Result, decode
from tests.specimens.first_line import Expected, code, expected, submissions

SAMPLE = submissions("sample")
FUNCTION_STAGES = {stage.name for stage in all_stages() if not stage.bonus}
REMARKS = {"lists": "returns a list", "columns": "returns a column", "integers": "returns integers"}


@pytest.fixture(scope="module")
def shown(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    """Run the demo once: its folder, and what it printed."""
    out = tmp_path_factory.mktemp("demo") / "slam1d-demo"
    return out, run(out)


def run(out: Path) -> str:
    """Run the demo into a folder; return what it prints on stdout."""
    with pytest.MonkeyPatch.context() as patch:
        lines: list[str] = []
        patch.setattr("click.echo", lambda text="", err=False, **_: None if err else lines.append(str(text)))
        with pytest.raises(SystemExit) as end:
            cli.main(["demo", "-o", str(out)])
    assert end.value.code == 0
    return "\n".join(lines)


def stored(out: Path, name: str) -> Result:
    """Read one stored result."""
    return decode((out / "results" / f"{name}.json").read_bytes())


def test_the_class_has_at_least_fourteen_modules_and_notebooks() -> None:
    """Right and wrong, unfinished, hanging, crashing and hostile."""
    assert len(SAMPLE) >= 14
    assert {path.suffix for path in SAMPLE} == {".py", ".ipynb"}
    statuses = {status for path in SAMPLE for status, _, _ in verdict(path).stages.values()}
    statuses |= {verdict(path).others for path in SAMPLE}
    assert statuses >= {"failed", "partial", "error", "timeout", "missing", "forbidden"}
    assert sum(verdict(path).others == "passed" and not verdict(path).stages for path in SAMPLE) >= 4


def verdict(path: Path) -> Expected:
    """Read the verdict in the first line of a submission."""
    return expected(code(path)[0].splitlines()[0])


@pytest.mark.parametrize("path", SAMPLE, ids=lambda path: path.stem)
def test_every_submission_gets_the_verdict_of_its_first_line(path: Path, shown: tuple[Path, str]) -> None:
    """Status, slip, follow-through and remarks are those that the specimen states."""
    wanted, result = verdict(path), stored(shown[0], path.stem)
    assert result.status == "graded"
    for stage in result.stages:
        if stage.name not in FUNCTION_STAGES and stage.name not in wanted.stages:
            continue  # the first line speaks of the stages that call functions
        status, slip, follows = wanted.stages.get(stage.name, (wanted.others, "", False))
        assert (stage.name, stage.status, stage.slip or "") == (stage.name, status, slip)
        assert ("The step keeps its points" in stage.message) == follows
    remarks = " ".join(remark for stage in result.stages for remark in stage.remarks)
    assert {kind for kind, words in REMARKS.items() if words in remarks} == set(wanted.remarks)


def test_the_demo_copies_the_homework_and_prints_where_everything_is(shown: tuple[Path, str]) -> None:
    """Every path that it prints exists."""
    out, text = shown
    assert (out / "assignment" / "slam1d.ipynb").is_file()
    printed = [Path(line.strip()) for line in text.splitlines() if line.strip().startswith(str(out))]
    assert len(printed) >= 6
    assert all(path.exists() for path in printed)
    assert out / "grades.csv" in printed


def test_the_demo_shows_one_named_mistake_on_a_small_graph(shown: tuple[Path, str]) -> None:
    """The counterexample has a picture, a call and marked entries."""
    text = shown[1]
    assert "x0 ---------> x1" in text
    assert "PoseGraph(" in text
    assert "(wrong entries in brackets)" in text


def test_grades_csv_has_a_row_for_everybody(shown: tuple[Path, str]) -> None:
    """As many rows as submissions, each graded."""
    with (shown[0] / "grades.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["submission"] for row in rows] == sorted(path.stem for path in SAMPLE)
    assert {row["status"] for row in rows} == {"graded"}


def test_a_second_run_works_and_grades_nothing_again(shown: tuple[Path, str]) -> None:
    """The same folder, the same marks."""
    out = shown[0]
    before = (out / "grades.csv").read_bytes(), (out / "results" / "ada_lindqvist.json").stat().st_mtime_ns
    run(out)
    assert ((out / "grades.csv").read_bytes(), (out / "results" / "ada_lindqvist.json").stat().st_mtime_ns) == before


def test_the_demo_overwrites_nothing_that_is_not_its_own(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A folder named `class` that somebody else filled is bad usage, and stays."""
    (tmp_path / "class").mkdir()
    (tmp_path / "class" / "notes.txt").write_text("mine")
    with pytest.raises(SystemExit) as end:
        cli.main(["demo", "-o", str(tmp_path)])
    assert end.value.code == 2
    assert (tmp_path / "class" / "notes.txt").read_text() == "mine"
    assert "choose another folder" in capsys.readouterr().err
