"""Names of submissions are safe, distinct and the same in every run."""

from __future__ import annotations

import unicodedata

import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.intake.naming import MAX_BYTES, distinct_names, printable, safe_name

RESERVED = {"con", "prn", "aux", "nul", "com1", "lpt9"}
names = st.one_of(
    st.text(max_size=300),
    st.text(st.sampled_from("./\\-_ aA\u0301\u212bß"), max_size=12),
    st.sampled_from(["con", "NUL.py", "..", "", "a" * 500, "ß", "ss", "SS", "-2", "a-2", "a"]),
)


@given(names)
def test_a_name_is_safe_as_a_file_name(text: str) -> None:
    """It has no separator, no control character, no leading dot or dash, and a bounded length."""
    name = safe_name(text)
    assert 0 < len(name.encode()) <= MAX_BYTES
    assert name.isprintable()
    assert not set(name) & set('/\\:*?"<>|\0\n')
    assert name[0] not in ".-=+@ "
    assert name[-1] not in ". "
    assert name.partition(".")[0].casefold() not in RESERVED
    assert safe_name(name) == name


@given(st.lists(st.tuples(names, names), max_size=12))
def test_names_are_distinct_without_regard_to_case(wanted: list[tuple[str, str]]) -> None:
    """A file system that folds case or composes letters keeps them apart too."""
    chosen = distinct_names(wanted)
    folded = [unicodedata.normalize("NFKC", name).casefold() for name in chosen]
    assert len(chosen) == len(wanted)
    assert len(set(folded)) == len(folded)
    assert chosen == distinct_names(wanted)


@given(st.lists(st.sampled_from("abcdefgh"), unique=True))
def test_names_that_differ_are_kept(wanted: list[str]) -> None:
    """Nobody is renamed without need."""
    assert distinct_names([(name, "folder") for name in wanted]) == wanted


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Doe, Jane (2)", "Doe, Jane (2)"),
        ("李雷", "李雷"),
        ("A\u030angstro\u0308m", "Ångström"),
        (".hidden", "hidden"),
        ("a/b", "a_b"),
        ("", "submission"),
        ("...", "submission"),
        ("COM1.x", "_COM1.x"),
        ("x\u202ey", "x_y"),
        ("jane@example.org", "jane@example.org"),
    ],
)
def test_names_of_people_survive(text: str, expected: str) -> None:
    """Letters of every script stay; what could mean something else goes."""
    assert safe_name(text) == expected


def test_a_number_is_not_given_twice() -> None:
    """A file that is really called hw-2 keeps its name."""
    assert distinct_names([("hw", ""), ("hw", ""), ("hw-2", "")]) == ["hw", "hw-3", "hw-2"]


@given(st.text())
def test_printable_text_is_one_line_that_can_be_encoded(text: str) -> None:
    """A terminal and a CSV file take it."""
    assert printable(text).isprintable()
    assert printable(text).encode().decode() == printable(text)
