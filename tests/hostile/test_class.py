"""A class with every hostile submission in it: the honest ones do not notice, and nothing is left behind."""

from __future__ import annotations

import json
import re
from typing import Any

import pytest

from tests.hostile import corpus, neighbours, traces, uploads
from tests.hostile.conftest import Graded
from tests.hostile.corpus import ENDED, Case

CASES = corpus.cases()
UPLOADS = list(uploads.uploads())


def without_seconds(graded: Graded, name: str) -> Any:
    """Read the file of a result, but for the time that it took."""
    found = json.loads((graded.out / "results" / f"{name}.json").read_text("utf-8"))
    found.pop("seconds")
    return found


def same(alone: Graded, together: Graded, name: str) -> bool:
    """Compare the result and the page of a submission in both runs."""
    page = [(one.out / "feedback" / f"{name}.html").read_bytes() for one in (alone, together)]
    return page[0] == page[1] and without_seconds(together, name) == without_seconds(alone, name)


def test_the_honest_ones_do_not_notice(alone: Graded, together: Graded, honest_names: list[str]) -> None:
    """Result and page of every honest submission are the same, to the byte, alone and among hostile ones."""
    changed = [name for name in honest_names if not same(alone, together, name)]
    assert changed == []


def test_a_member_of_its_group_cannot_mislead_an_honest_one(alone: Graded, together: Graded) -> None:
    """Nobody's explanation depends on what another member of the group answers after the exam."""
    assert same(alone, together, neighbours.SHARED_MISTAKE)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_a_hostile_one_has_at_most_its_honest_marks(together: Graded, case: Case) -> None:
    """It gets the verdict of its first line, and no point beyond the stages that it did honestly."""
    result = together.result(case.name)
    assert result.status == "graded"
    assert result.score is not None
    assert result.score <= case.honest()
    for stage in result.stages:
        if stage.bonus and stage.name not in case.expected.stages:
            continue
        wanted = case.expected.status(stage.name)
        assert stage.status == wanted or {stage.status, wanted} <= ENDED, (stage.name, stage.status, stage.message)
        if wanted == "passed":
            assert stage.score == stage.max_score


@pytest.mark.parametrize("upload", UPLOADS, ids=lambda upload: re.sub(r"\W+", "_", upload.name))
def test_a_hostile_upload_is_refused_or_graded_on_merit(together: Graded, upload: uploads.Upload) -> None:
    """What could harm is refused in a sentence that says why; of the rest the honest part counts."""
    result = together.result(upload.result)
    if upload.refused:
        assert (result.status, result.score) == ("rejected", 0.0)
        assert upload.refused in result.message
    else:
        assert result.status == "graded", result.message
        assert result.score == next(stage.score for stage in result.stages if stage.name == "residual")
        assert result.score or "it took longer than" in result.notes[0]


def test_everybody_has_a_result(together: Graded, honest_names: list[str]) -> None:
    """Nobody is lost, and nothing in the class was the grader's fault."""
    results = together.results()
    assert len(results) == len(honest_names) + len(CASES) + len(UPLOADS)
    assert {result.status for result in results.values()} == {"graded", "rejected"}


def test_nothing_is_left(together: Graded) -> None:
    """No file, object, queue, key, socket or process stays, and no environment changes."""
    assert traces.found(together.out, together.uploads, together.out.parent) == []
    assert together.guard["processes_left"] == 0
    assert together.guard["environment_changed"] is False


def test_nothing_is_signalled(together: Graded) -> None:
    """The run ends by itself with 0, and nobody around it hears a signal."""
    assert (together.guard["code"], together.guard["signals"]) == (0, [])


def test_the_run_ends_in_time(together: Graded) -> None:
    """A hostile submission costs no more than twice its own limits: once, and once more alone to confirm."""
    submissions = len(together.results())
    assert together.guard["cpu_seconds"] < 2 * 4 * 0.25 * submissions
    assert together.guard["seconds"] < 3 * 2 * 4 * 0.25 * submissions


def test_the_grader_stays_small(together: Graded) -> None:
    """Neither the grader nor a worker of it grows, whatever comes in and goes out."""
    assert together.guard["peak_kib"] < 400 * 1024


def test_the_uploads_are_untouched(together: Graded) -> None:
    """What was handed in is still there, byte for byte, and nothing else is."""
    wanted = {case.path.name: case.path.read_bytes() for case in CASES}
    wanted |= {upload.name: upload.data for upload in UPLOADS}
    found = {path.name: path.read_bytes() for path in together.uploads.iterdir()}
    assert {name: found[name] for name in wanted} == wanted


def test_what_is_printed_is_printable(together: Graded) -> None:
    """No escape of a submission or of its name reaches the terminal, and no markup a page."""
    shown = re.sub(r"\x1b\[[0-9;]*[mK]", "", together.printed)
    assert "\x1b" not in shown
    assert "\u202e" not in shown
    for page in [together.out / "report.html", *(together.out / "feedback").glob("*.html")]:
        text = page.read_text("utf-8")
        assert "<script>alert" not in text, page.name
        assert "\u202e" not in text, page.name
        assert "onerror=alert" not in re.sub(r"&lt;.*?&gt;", "", text), page.name
