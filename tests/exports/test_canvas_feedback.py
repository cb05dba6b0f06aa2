"""The archive for Canvas's "Upload Submissions": right names, files of the right kind, nobody else's words."""

from __future__ import annotations

import ast
import io
import zipfile

import nbformat
import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.errors import UsageError
from autograder.exports.bundle import bundle, names_in
from autograder.exports.canvas.feedback import content, feedback_archive
from tests.reports.examples import result

UPLOADS = [
    "doejane_101_2001_slam1d.py",
    "doejane_LATE_101_2009_slam1d-1.ipynb",
    "doejane_102_2002_my_work_3.zip",
    "zmuller_103_2003_slam1d.py",
    "__MACOSX/._doejane_101_2999_slam1d.py",
    "notes.txt",
]


def test_a_file_goes_under_the_name_of_the_newest_upload() -> None:
    """Canvas reads the first two numbers between underscores: the student's, then the upload's."""
    owners = {"101": result("jane"), "102": result("other"), "105": result("nobody")}
    texts = {one.submission: f"for {one.submission}\n" for one in owners.values()}
    returned = feedback_archive(UPLOADS, "submissions.zip", owners, texts)
    names = names_in(returned.data, "feedback.zip")
    assert names == ["doejane_102_2002_my_work_3.zip", "doejane_LATE_101_2009_slam1d-1.ipynb"]
    numbers = [[part for part in name.split("_") if part.isdigit()][:2] for name in names]
    assert numbers == [["102", "2002"], ["101", "2009"]]
    assert any("No upload in submissions.zip: nobody;" in note for note in returned.notes)


def test_each_file_is_what_its_name_says() -> None:
    """A .py is comments, an .ipynb a valid notebook, a .zip an archive."""
    text = "75 of 90 points\n``` '''\nx = 1\n"
    assert ast.parse(content("a.py", text)).body == []
    notebook = nbformat.reads(content("a.ipynb", text).decode(), as_version=4)
    nbformat.validate(notebook)
    assert "x = 1" in notebook.cells[0].source
    with zipfile.ZipFile(io.BytesIO(content("a.zip", text))) as archive:
        assert archive.read("feedback.txt").decode() == text
    assert content("a.txt", text).decode() == text


@given(st.text(max_size=200))
def test_no_text_becomes_code(text: str) -> None:
    """Whatever a message holds, the file of a .py is comments and nothing else."""
    assert ast.parse(content("a.py", text)).body == []


@pytest.mark.parametrize("cut", [0, 10, 200])
def test_a_truncated_archive_is_named(cut: int) -> None:
    """An archive that was cut short is refused in a sentence."""
    data = bundle(dict.fromkeys(UPLOADS, b"x" * 100))[:cut]
    with pytest.raises(UsageError, match=r"submissions\.zip is no whole zip archive; was the download cut short"):
        names_in(data, "submissions.zip")


def test_an_archive_of_another_course_is_refused() -> None:
    """Where no upload is of anybody who was graded, nothing is written."""
    with pytest.raises(UsageError, match="holds no upload of anybody who was graded"):
        feedback_archive(UPLOADS, "submissions.zip", {"999": result("jane")}, {"jane": ""})
