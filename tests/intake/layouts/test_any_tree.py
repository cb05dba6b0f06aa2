"""Whatever a tree looks like, no layout fails on it and no submission in it is lost."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from autograder.intake.layouts import Layout, detect, layouts
from autograder.intake.layouts.gradescope import read_metadata
from autograder.intake.tree import Entry, Tree, is_candidate

PARTS = st.sampled_from(
    [
        *("alice", "bob", "submitted", "ps1", "submission_1", "submission_2", ".git", "hw-alice", "hw-bob", "tests"),
        *("Jane Doe_1_assignsubmission_file", "Jane Doe_2_assignsubmission_file_", "slam1d", "..", "é"),
    ]
)
FILES = st.sampled_from(
    [
        *(
            "slam1d.py",
            "hw.ipynb",
            "x.zip",
            "posegraph.py",
            "notes.txt",
            "x.rar",
            "timestamp.txt",
            "noext",
            "test_x.py",
        ),
        *("doejane_1_2_slam1d.py", "doejane_LATE_1_3_slam1d-1.py", "roejohn_2_text.html", "anon_ab1_4_hw.py"),
        *("Jane Doe_3_assignsubmission_file_hw.py", "submission_metadata.yml"),
    ]
)
PATHS = st.builds(lambda folders, name: (*folders, name), st.lists(PARTS, max_size=4), FILES)
METADATA = b"submission_1:\n  :submitters:\n  - :name: A\n    :sid: 1\nsubmission_3:\n  :submitters:\n  - :name: B\n"


def make(paths: list[tuple[str, ...]], name: str, *, archive: bool = False) -> Tree:
    """Build a tree of files at these paths."""
    entries = tuple(Entry(path, "/".join(path), lambda _: METADATA) for path in sorted(paths))
    folders = frozenset(path[:depth] for path in paths for depth in range(1, len(path)))
    return Tree(name, entries, folders, archive)


@given(st.lists(PATHS, max_size=8, unique=True), st.sampled_from(["class", "submitted", "alice"]), st.booleans())
def test_every_layout_takes_every_tree(paths: list[tuple[str, ...]], name: str, archive: bool) -> None:
    """Sureness is a share, and each upload has a name and either a file or a reason."""
    tree = make(paths, name, archive=archive)
    for layout in layouts():
        assert 0 <= layout.recognise(tree) <= 1
        for upload in layout.gather(tree):
            assert upload.name
            assert upload.entry is not None or upload.problem
            assert upload.entry is None or upload.entry.origin in {entry.origin for entry in tree.entries}


@given(st.lists(PATHS, min_size=1, max_size=8, unique=True))
def test_a_tree_with_a_submission_in_it_gives_uploads(paths: list[tuple[str, ...]]) -> None:
    """Whatever is detected, a folder with submissions is never called empty."""
    tree = make(paths, "class")
    if any(is_candidate(entry) for entry in tree.entries):
        layout, inner = detect(tree)
        assert isinstance(layout, Layout)
        assert layout.gather(inner)


@given(st.text(st.sampled_from(" -:\n'\"\\xsubmitersnameid_1|#[]{}"), max_size=200))
def test_any_text_is_taken_as_metadata(text: str) -> None:
    """What is not understood is skipped; names are safe to print."""
    for record in read_metadata(text).values():
        assert all(value.isprintable() for person in record.submitters for value in person.values())
