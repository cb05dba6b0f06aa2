"""Notebooks are valid nbformat 4.5 with ids that stay."""

import json

import nbformat
import pytest

from autograder.render.notebook import build_notebook, render_notebook


def test_cells_keep_kind_name_and_text():
    """A cell's name is its id; the lines between two heads are its source."""
    notebook = build_notebook("%% markdown one\n# Title\n\n%% code two\n\nx = 1\n\n\n%% provided three\ny = 2\n")
    assert [(cell.cell_type, cell.id, cell.source) for cell in notebook.cells] == [
        ("markdown", "one", "# Title"),
        ("code", "two", "x = 1"),
        ("code", "three", "y = 2"),
    ]
    assert notebook.cells[2].metadata["jupyter"] == {"source_hidden": True}


def test_the_format_is_4_5_for_python3():
    """Any Jupyter opens it with its Python 3 kernel."""
    notebook = json.loads(nbformat.writes(build_notebook("%% code one\n1\n")))
    assert (notebook["nbformat"], notebook["nbformat_minor"]) == (4, 5)
    assert notebook["metadata"]["kernelspec"]["name"] == "python3"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("words\n%% code one\n1\n", "must begin with a line"),
        ("%% code one\n1\n%% code one\n2\n", r"\['one'\] more than once"),
    ],
)
def test_a_template_with_a_mistake_is_refused(text, message):
    """Text before the first cell and a doubled name are errors."""
    with pytest.raises(ValueError, match=message):
        build_notebook(text)


def test_what_is_written_is_what_nbformat_writes(monkeypatch):
    """The quick way to the text of a file gives the bytes of the slow one, and validates."""
    template = "%% markdown one\n# Größe\n\ntext\n\n%% code two\nx = 1\n\ny = 2\n\n%% provided three\n"
    monkeypatch.setattr("autograder.render.notebook.fill", lambda *_, **__: template)
    text = render_notebook("any", {"slam1d": {"variant": "A-0"}})
    notebook = build_notebook(template)
    notebook.metadata["slam1d"] = {"variant": "A-0"}
    assert text == nbformat.writes(notebook, version=4) + "\n"
    nbformat.validate(nbformat.reads(text, as_version=4))
