"""From a student's notebook to the reader's page: words, pictures and the time go all the way."""

from __future__ import annotations

import base64
import json
from collections.abc import Callable
from pathlib import Path

import pytest

from autograder.verdicts import decode
from tests.intake.test_pictures import chunk, encoded, png

Ended = tuple[int, str, str]
COURSE = "[grading]\nexamples = 5\n[late]\ndue = 2026-11-20T23:59:00Z\nper_day = 10\n"


def notebook(path: Path) -> None:
    """Write a notebook with an answer to question 2 and a pasted picture in it."""
    answer = "**Your answer to question 2** (edit this cell): zero, see ![plot](attachment:image.png)"
    camera = png(chunk(b"tEXt", b"GPS\x0052.5 13.4"))
    cells = [
        {"cell_type": "code", "metadata": {}, "source": "x = 1", "outputs": [], "execution_count": None},
        {"cell_type": "markdown", "metadata": {}, "source": "## Question 2\n\nWhat happens?"},
        {
            "cell_type": "markdown",
            "metadata": {},
            "source": answer,
            "attachments": {"image.png": {"image/png": encoded(camera)}},
        },
    ]
    path.write_text(json.dumps({"cells": cells, "metadata": {}, "nbformat": 4, "nbformat_minor": 5}))


@pytest.mark.slow
def test_an_answer_with_a_picture_handed_in_late(run: Callable[..., Ended], tmp_path: Path) -> None:
    """The picture is on the page without what the camera added, and the late rule goes by the platform's time."""
    place = tmp_path / "submitted" / "ada" / "ps1"
    place.mkdir(parents=True)
    notebook(place / "slam1d.ipynb")
    (place / "timestamp.txt").write_text("2026-11-21 10:00:00.000000 UTC\n")
    (tmp_path / "course.toml").write_text(COURSE)
    out = tmp_path / "out"
    assert run("grade", tmp_path / "submitted", "-o", out, "--course", tmp_path / "course.toml")[0] == 0
    result = decode((out / "results" / "ada.json").read_bytes())
    assert result.submitted.startswith("2026-11-21 10:00:00")
    assert list(result.written) == ["2"]
    assert list(result.images.values()) == [f"data:image/png;base64,{base64.b64encode(png()).decode()}"]
    page = (out / "written.html").read_text(encoding="utf-8")
    assert f'<img src="{result.images.popitem()[1]}" alt="plot">' in page
    sheet = (out / "written.csv").read_text(encoding="utf-8")
    (tmp_path / "filled.csv").write_text(sheet.rstrip("\n").removesuffix(",") + "2,\n")
    code, _, err = run("report", out, "--marks", tmp_path / "filled.csv")
    assert code == 0, err
    student = (out / "feedback" / "ada.html").read_text(encoding="utf-8")
    assert "<strong>0</strong> of 100" in student, "two points for the answer, ten off"
    assert "handed in 1 day late: 10 % of 100 points for each begun day" in student
