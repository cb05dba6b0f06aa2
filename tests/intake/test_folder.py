"""Folders on disk: bounded walks, and the same answer in whatever order they are listed."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from autograder.errors import UsageError
from autograder.intake import folder as module
from autograder.intake.folder import folder_tree, read_regular
from autograder.intake.submission import collect
from tests.intake.making import CODE, archive, write


def test_a_walk_ends_at_its_bounds(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A disk given by mistake, or folders without end, are refused with what to do."""
    write(tmp_path, {"a/b/c/d/x.py": CODE})
    monkeypatch.setattr(module, "MAX_DEPTH", 3)
    with pytest.raises(UsageError, match="is nested over 3 folders deep; give one further down"):
        folder_tree(tmp_path)
    monkeypatch.setattr(module, "MAX_ENTRIES", 2)
    with pytest.raises(UsageError, match="holds more than 2 files; give the folder of the submissions"):
        folder_tree(tmp_path)


def test_a_folder_that_cannot_be_listed_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Below the root it is one student's trouble, at the root the user's."""
    write(
        tmp_path, {"class/alice/x.py": CODE, "class/jane.doe/x.py": CODE, "plain/a.py": CODE, "plain/jane.d/x.py": CODE}
    )
    real = os.scandir

    def refuse(path: Path) -> Iterator[os.DirEntry[str]]:
        if "." in Path(path).name:
            raise PermissionError(13, "Permission denied")
        return real(path)

    monkeypatch.setattr(os, "scandir", refuse)
    for name, others in (("class", "alice"), ("plain", "a")):
        found = {each.id: each for each in collect([tmp_path / name])}
        (shut,) = found.keys() - {others}
        assert "is a folder that cannot be listed (Permission denied); check its permissions." in found[shut].rejection
        assert found[others].source is not None
    (tmp_path / "x.y").mkdir()
    with pytest.raises(UsageError, match="x.y cannot be listed"):
        collect([tmp_path / "x.y"])


def test_links_in_circles_end(tmp_path: Path) -> None:
    """Neither the walk nor the reading of a link goes round."""
    write(tmp_path, {"class/alice.py": CODE})
    (tmp_path / "class" / "round").symlink_to(".")
    (tmp_path / "class" / "self.py").symlink_to("self.py")
    found = {each.id: each.rejection for each in collect([tmp_path / "class", tmp_path / "class" / "self.py"])}
    assert found["alice"] == ""
    assert found["round"] == "round is a link to a folder; hand in the file itself."
    assert all(found[name] for name in found if name != "alice")


def test_no_more_is_read_than_the_limit_and_one_byte(tmp_path: Path) -> None:
    """One byte too many says that the file is too large, without reading it all."""
    write(tmp_path, {"a.py": b"x" * (3 << 20)})
    assert len(read_regular(tmp_path / "a.py", 10)) == 11
    assert len(read_regular(tmp_path / "a.py", 2 << 20)) == (2 << 20) + 1
    assert len(read_regular(tmp_path / "a.py", 4 << 20)) == 3 << 20


def test_the_order_of_paths_and_listings_does_not_count(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The same files give the same ids, notes and digests on every machine."""
    write(tmp_path, {"one/a.py": "1", "one/A.ipynb": "x", "two/a.py": "2", "two/b.zip": archive({"x.py": "3"})})
    paths = [tmp_path / "one", tmp_path / "two", tmp_path / "missing"]
    expected = collect(paths)
    real = os.scandir

    class Backwards:
        def __init__(self, path: Path) -> None:
            with real(path) as scan:
                self.items = sorted(scan, key=lambda item: item.name, reverse=True)

        def __enter__(self) -> Iterator[os.DirEntry[str]]:
            return iter(self.items)

        def __exit__(self, *_: object) -> None:
            return None

    monkeypatch.setattr(os, "scandir", Backwards)
    assert collect(paths[::-1]) == expected
