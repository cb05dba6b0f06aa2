"""Notebooks: what is read agrees with Jupyter's own reader, and what is odd is bounded and said in words."""

from __future__ import annotations

import json
import random
import tracemalloc
from pathlib import Path
from typing import Any

import nbformat
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output, new_raw_cell

from autograder.errors import RejectedUpload
from autograder.intake.module import MAX_SOURCE
from autograder.intake.notebook import MAX_NOTEBOOK, read_notebook
from tests.intake.making import cell, notebook

ROOT = Path(__file__).resolve().parents[2]
sources = st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\r"), max_size=40)
cells = st.one_of(
    st.builds(new_code_cell, sources, outputs=st.just([new_output("stream", text="score: 100")])),
    st.builds(new_markdown_cell, sources),
    st.builds(new_raw_cell, sources),
)


def agrees(data: bytes) -> bool:
    """Say whether our reading is that of nbformat.read."""
    theirs = nbformat.reads(data.decode(), as_version=4)
    ours = read_notebook(data)
    code = tuple(each.source for each in theirs.cells if each.cell_type == "code")
    markdown = tuple(each.source for each in theirs.cells if each.cell_type == "markdown")
    return (ours.code, ours.markdown) == (code, markdown)


def rejection(data: bytes) -> str:
    """Return why the notebook is rejected."""
    with pytest.raises(RejectedUpload) as raised:
        read_notebook(data)
    return str(raised.value)


@settings(max_examples=40)
@given(st.lists(cells, min_size=1, max_size=6), st.sampled_from([0, 2, 4, 5]))
def test_reading_agrees_with_jupyter(drawn: list[Any], minor: int) -> None:
    """Whatever Jupyter writes, the same code cells and markdown cells come out."""
    for number, each in enumerate(drawn):
        each.pop("id", None)
        if minor >= 5:
            each["id"] = f"c{number}"
    assert agrees(nbformat.writes(new_notebook(cells=drawn, nbformat_minor=minor)).encode())


def test_reading_agrees_with_jupyter_on_the_notebooks_of_this_project() -> None:
    """The stub's notebook, and every other one that is here."""
    folders = ("assignment", "reference_solution", "autograder/specimens")
    for path in (path for folder in folders for path in (ROOT / folder).rglob("*.ipynb")):
        data = path.read_bytes()
        try:
            theirs = nbformat.reads(data.decode(), as_version=4)
        except (nbformat.reader.NotJSONError, UnicodeDecodeError, AttributeError, KeyError):
            continue
        assert not theirs.get("cells") or agrees(data), path


def test_whatever_happened_to_the_cells_they_are_read() -> None:
    """Duplicated, retyped and missing ids, odd metadata and lost fields change nothing."""
    data = notebook(
        cell("a = 1", id="same"),
        cell("b = 2", id="same"),
        {"cell_type": "code", "source": ["c = 3\n", "d = 4"], "id": 17, "metadata": None},
        {"cell_type": "code", "metadata": {"deletable": False, "nbgrader": {"points": 1e9}}, "outputs": "none"},
        {"cell_type": "code", "source": "e = 5", "execution_count": "many", "outputs": [{"output_type": "error"}]},
        {"source": "f = 6", "cell_type": "heading", "level": 1},
        {"source": "g = 7", "cell_type": "raw"},
        metadata=[],
        nbformat_minor="five",
    )
    read = read_notebook(data)
    assert read.code == ("a = 1", "b = 2", "c = 3\nd = 4", "", "e = 5")
    assert read.markdown == ()
    assert read.notes == ()


def test_markdown_and_raw_cells_are_never_code() -> None:
    """Text that looks like code stays text; a notebook of text only is read, and said."""
    read = read_notebook(
        notebook(cell("import os", "markdown"), cell("x = 1", "raw"), cell(["# t\n", "u"], "markdown"))
    )
    assert read.code == ()
    assert read.markdown == ("import os", "# t\nu")
    assert read.notes == ("The notebook has no code cell.",)


def test_the_last_of_two_equal_keys_counts_as_in_jupyter() -> None:
    """A notebook cannot show one thing to a reader and another to the grader."""
    data = (
        b'{"nbformat": 3, "nbformat_minor": 5, "metadata": {}, "cells": [], "nbformat": 4, "cells": ['
        b'{"cell_type": "raw", "metadata": {}, "source": "old", "id": "a", "cell_type": "markdown", "source": "new"}]}'
    )
    assert agrees(data)
    assert read_notebook(data).markdown == ("new",)


def test_a_version_that_is_odd_is_read_with_a_note() -> None:
    """Only formats that keep their cells elsewhere are refused."""
    for version, words in [(5, "'5'"), ("4", "'\"4\"'"), (None, "'null'"), (10**400, "'100000000000'")]:
        assert words in read_notebook(notebook(cell(), nbformat=version)).notes[0]
    assert not read_notebook(notebook(cell(), nbformat=4.0)).notes
    assert read_notebook(b'\xef\xbb\xbf\n{"cells": [{"cell_type": "code", "source": "x\\r\\ny"}]}').code == ("x\ny",)


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "is empty, expected a notebook"),
        (b"x = 1", "is no notebook (not JSON); a Python file needs a name that ends in .py"),
        (b"[1, 2]", "is JSON but no notebook (Expected `object`, got `array`)"),
        (b"{}", "is JSON but no notebook (it has no cells)"),
        (b'{"cells": 5}', "is JSON but no notebook (Expected `array`, got `int` - at `$.cells`)"),
        (b'{"cells": [5]}', "is JSON but no notebook (Expected `object`, got `int` - at `$.cells[0]`)"),
        (b'{"cells": [{}]}', "missing required field `cell_type`"),
        (b'{"cells": []}', "is a notebook without cells"),
        (b'{"cells": [{"cell_type": "code", "source": 5}]}', "has no readable text in any of its 1 code cells"),
        (b'{"cells": [{"cell_type": "code", "source": [["x"]]}]}', "has no readable text in any of its 1 code cells"),
        (b'{"cells": [{"cell_type": "code", "source": "\xff"}]}', "has no readable text in any of its 1 code cells"),
        (b'{"cells": [],\n"x": NaN}', "is no valid JSON (line 2), so no notebook; open it in Jupyter"),
        (b'{"cells": [{"cell_type": "code"', "is cut off before its end; save it in Jupyter"),
        (b"<!DOCTYPE html>\n<html>Sign in</html>", "is a web page, no notebook; it may be a page that asks to sign in"),
        (b'{"worksheets": [{"cells": []}], "nbformat": 3}', "is a notebook without cells"),
        (b'{"worksheets": 5}', "is a notebook of format 3"),
        (b'{"cells": [], "nbformat": 2}', "is a notebook of format 2"),
        (b'{\n<<<<<<< HEAD\n"cells": []\n=======\n>>>>>>> mine\n}', "holds an unfinished git merge"),
        ('{"cells": []}'.encode("utf-16"), "is text in UTF-16"),
        (b'{"a":' * 100_000, "is JSON nested too deeply"),
        (b'{"cells": [{"cell_type": "code", "source": ' + b"[" * 100_000, "is JSON nested too deeply"),
        (notebook(*[cell("x")] * 10_001), "has 10001 cells, more than the limit of 10000"),
        (notebook(cell("#" * (MAX_SOURCE + 1))), "has more than 1 MiB of code"),
        (notebook(*[cell("é" * (MAX_SOURCE // 8))] * 5), "has more than 1 MiB of code"),
        (notebook(cell([""] * 3_000_000)), "has more than 1 MiB of code"),
        (b" " * (MAX_NOTEBOOK + 1), "is larger than 20 MiB; clear all outputs"),
    ],
)
def test_what_is_no_notebook_is_rejected_in_words(data: bytes, words: str) -> None:
    """What came, what was expected, what to try."""
    assert words in rejection(data)


def test_the_limit_of_code_applies_after_outputs_are_dropped() -> None:
    """A notebook of many MiB of pictures and 1 MiB of code is read."""
    picture = {"output_type": "display_data", "data": {"image/png": "A" * (8 << 20)}, "metadata": {}}
    assert read_notebook(notebook(cell("x" * MAX_SOURCE, outputs=[picture]), cell("t" * 9, "markdown"))).code


def test_numbers_without_bound_in_skipped_fields_cost_nothing() -> None:
    """Huge integers and exponents in outputs are never turned into numbers."""
    digits = b"9" * 1_000_000
    data = b'{"cells": [{"cell_type": "code", "source": "x", "execution_count": %s, "outputs": [1e999999]}]}' % digits
    assert read_notebook(data).code == ("x",)


def test_memory_stays_within_a_few_times_the_file() -> None:
    """The densest notebooks that there can be are refused before they grow."""
    size = 2 << 20
    for item in (b'{"cell_type":"x","source":1},', b'{"cell_type":""},'):
        data = b'{"cells":[' + item * (size // len(item)) + b"{}]}"
        tracemalloc.start()
        assert rejection(data)
        _, peak = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        assert peak < 8 * size


def test_nothing_but_our_own_error_comes_out_of_a_mutated_notebook() -> None:
    """Bytes of a real notebook are cut, doubled and changed; each is read or rejected."""
    data = bytearray(notebook(cell(["a\n", "é"]), cell("# t", "markdown"), cell("b", outputs=[{"x": [1e5, None]}])))
    draw = random.Random(1)
    rejected = 0
    for _ in range(1500):
        mutant = bytearray(data)
        for _ in range(draw.randint(1, 4)):
            at, to = draw.randrange(len(mutant)), draw.randrange(len(mutant))
            kind = draw.randrange(4)
            if kind == 0:
                mutant[at] = draw.randrange(256)
            elif kind == 1:
                del mutant[at : at + draw.randint(1, 9)]
            elif kind == 2:
                mutant[at:at] = mutant[min(at, to) : max(at, to)]
            else:
                mutant[at:at] = draw.choice([b"[", b"{", b"NaN", b"9" * 400, b"\\ud800", b"\xff", b'"', b"null"])
        try:
            assert all(text.encode() is not None for text in read_notebook(bytes(mutant)).code)
        except RejectedUpload:
            rejected += 1
    assert 100 < rejected < 1500


def test_half_a_surrogate_pair_is_replaced() -> None:
    """Python writes it where a program printed broken text; whole pairs and escaped backslashes stay as they are."""
    source = rb"\ud800 \\ud800 \\\ud800\ud83d\ude00\ude00\ud83d"
    data = b'{"cells": [{"cell_type": "code", "source": "%s"}]}' % source
    assert read_notebook(data).code == ("\ufffd \\ud800 \\\ufffd\U0001f600\ufffd\ufffd",)


FIELDS = st.sampled_from(["cells", "cell_type", "source", "nbformat", "worksheets", "x"])
JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.text(max_size=5),
    lambda inner: st.lists(inner) | st.dictionaries(FIELDS, inner),
    max_leaves=8,
)


@given(JSON)
def test_any_json_is_read_or_rejected(value: Any) -> None:
    """Fields of the wrong type are said, wherever they stand."""
    for data in (value, {"cells": value}, {"cells": [value]}, {"cells": [{"cell_type": "code", "source": value}]}):
        try:
            read_notebook(json.dumps(data).encode())
        except RejectedUpload as error:
            assert str(error).split()[0] in {"is", "has"}  # noqa: PT017 (either outcome is right)


@pytest.mark.parametrize(
    ("metadata", "stated"),
    [
        ({"slam1d": {"variant": "A-0123456789abcdef"}, "kernelspec": {}}, "A-0123456789abcdef"),
        ({"slam1d": {}}, ""),
        ({"slam1d": {"variant": 7}}, ""),
        ({"slam1d": ["A"]}, ""),
        ({"slam1d": {"variant": "A" * 65}}, ""),
        ({"slam1d": {"variant": "A\n"}}, ""),
        ([], ""),
        (None, ""),
    ],
)
def test_the_variant_in_the_metadata_is_read_where_there_is_one(metadata: object, stated: str) -> None:
    """Of the metadata one short text is read; whatever else stands there neither counts nor hurts."""
    assert read_notebook(notebook(cell("x = 1"), metadata=metadata)).variant == stated


def test_one_bad_cell_costs_itself() -> None:
    """A source that is null, or lines without line ends, are read as well as they can be, and that is said."""
    read = read_notebook(
        notebook(cell("a = 1"), {"cell_type": "code", "source": None}, cell(["def f():", "    return 1"]))
    )
    assert read.code == ("a = 1", "", "def f():\n    return 1")
    assert [note.partition(" ")[0] for note in read.notes] == ["Cell", "Cell"]
    assert "Cell 2 has no readable text" in read.notes[0]
    assert "Cell 3 is a list of lines without line ends" in read.notes[1]


def test_format_3_is_read() -> None:
    """Older notebooks keep their cells in worksheets and call what was typed `input`."""
    cells = [{"cell_type": "markdown", "source": ["# a"]}, {"cell_type": "code", "input": ["x = 1\n", "y = 2"]}]
    read = read_notebook(json.dumps({"nbformat": 3, "metadata": {}, "worksheets": [{"cells": cells}]}).encode())
    assert (read.code, read.markdown, read.notes) == (("x = 1\ny = 2",), ("# a",), ())


def test_cells_are_called_as_the_notebook_shows_them() -> None:
    """All cells are counted, and the number that Jupyter shows beside one that was run is named."""
    run = {"cell_type": "code", "source": "x", "execution_count": 7}
    read = read_notebook(notebook(cell("# t", "markdown"), run, cell("y"), {**run, "execution_count": "9"}))
    assert read.labels == ("cell 2 (In [7])", "cell 3", "cell 4")
