"""What comes in as files and folders comes out as submissions, each read or rejected in a sentence."""

from __future__ import annotations

import json
import os
import socket
from pathlib import Path

import pytest

from autograder.errors import UsageError
from autograder.intake.submission import Submission, collect
from autograder.problems.problem import worked_problem
from autograder.render.handout import render_folder
from autograder.sandbox.frames import Source
from tests.intake.making import CODE, archive, cell, notebook, write


def by_id(*paths: Path, layout: str | None = None) -> dict[str, Submission]:
    """Collect, by id."""
    found = collect(paths, layout)
    assert [each.id for each in found] == sorted(each.id for each in found)
    assert all((each.source is None) == bool(each.rejection) == (not each.digest) for each in found)
    assert all(each.rejection == "" or each.rejection.endswith(".") for each in found)
    return {each.id: each for each in found}


def test_modules_and_notebooks_of_a_folder_are_read(tmp_path: Path) -> None:
    """A module is one cell, a notebook its code cells; both are called by their stem."""
    write(tmp_path / "class", {"alice.py": CODE, "bob.ipynb": notebook(cell("a = 1"), cell("# b", "markdown"), cell())})
    found = by_id(tmp_path / "class")
    assert found["alice"].source == Source(kind="module", cells=[CODE], name="alice.py")
    assert found["alice"].path == "class/alice.py"
    assert found["bob"].source == Source("notebook", ["a = 1", CODE], "bob.ipynb", ["cell 1", "cell 3"])
    assert found["bob"].markdown == ("# b",)


def test_the_digest_is_of_what_is_executed(tmp_path: Path) -> None:
    """Names, outputs and line ends do not count; kind and every cell's border do."""
    write(
        tmp_path,
        {
            "a.py": "x\ny\n",
            "b.py": "x\r\ny\r\n",
            "c.py": "x\ny",
            "d.ipynb": notebook(cell("x"), cell("y")),
            "e.ipynb": notebook(cell("xy"), cell("")),
            "f.ipynb": notebook(cell("x", outputs=[{"output_type": "stream"}]), cell("y", metadata={"points": 100})),
            "g.ipynb": notebook(cell("x\ny\n")),
        },
    )
    digest = {name: each.digest for name, each in by_id(tmp_path).items()}
    assert digest["a"] == digest["b"]
    assert digest["d"] == digest["f"]
    assert len(set(digest.values())) == 5
    assert all(len(value) == 64 for value in digest.values())


def test_what_tools_leave_behind_and_what_was_handed_out_is_ignored(tmp_path: Path) -> None:
    """Caches, checkpoints, hidden files and the provided files are no submissions."""
    noise = ["__pycache__/x.py", ".ipynb_checkpoints/x.ipynb", "__MACOSX/x.py", ".x.py", "._x.py", ".git/x.py"]
    provided = ["posegraph.py", "self_check.py", "sub/PoseGraph.py", "README.md", "venv/lib/x.py"]
    write(tmp_path, dict.fromkeys([*noise, *provided, "alice.py", "venv/pyvenv.cfg", ".DS_Store"], CODE))
    assert list(by_id(tmp_path)) == ["alice"]


def test_a_bad_upload_stops_nobody_else(tmp_path: Path) -> None:
    """Each rejected upload has its sentence, and the others are read."""
    write(
        tmp_path,
        {
            "good.py": CODE,
            "binary.py": b"\x00\x01\x02",
            "big.py": b"#" * (1 << 20) + b"\n",
            "big2.ipynb": b" " * (50 << 20),
            "json.ipynb": b'{"a": 1}',
            "old.ipynb": b'{"nbformat": 3, "worksheets": [{"cells": []}]}',
            "none.ipynb": notebook(),
            "text.ipynb": b"def f(): pass",
            "packed.rar": b"Rar!",
            "renamed.py.txt": CODE,
            "poetry.py": "shall I compare thee",
            "empty.py": b"",
        },
    )
    found = by_id(tmp_path)
    assert {name: each.rejection for name, each in found.items()} == {
        "good": "",
        "poetry": "",  # whether it is Python is found out in the sandbox
        "empty": "",
        "binary": "binary.py is a binary file (it holds zero bytes), expected Python source; hand in the source text.",
        "big": "big.py is larger than 1 MiB, the limit for a .py file; remove data from the source.",
        "big2": "big2.ipynb is larger than 20 MiB; clear all outputs in Jupyter, save it and hand it in again.",
        "json": "json.ipynb is JSON but no notebook (it has no cells); save the notebook in Jupyter and hand in that.",
        "old": "old.ipynb is a notebook without cells; check that you handed in the file you worked in.",
        "none": "none.ipynb is a notebook without cells; check that you handed in the file you worked in.",
        "text": "text.ipynb is no notebook (not JSON); a Python file needs a name that ends in .py.",
        "packed": "packed.rar is a RAR archive; pack it as .zip.",
        "renamed": "",
    }
    assert found["empty"].notes == ("The file is empty.",)


def test_what_is_no_file_is_rejected_without_waiting(tmp_path: Path) -> None:
    """Pipes, sockets and folders that are named like a submission are never opened."""
    write(tmp_path, {"good.py": CODE})
    os.mkfifo(tmp_path / "pipe.py")
    os.mkfifo(tmp_path / "packed.zip")
    write(tmp_path / "folder.py", {"x.py": CODE})
    with socket.socket(socket.AF_UNIX) as server:
        here = Path.cwd()
        os.chdir(tmp_path)  # the path of a socket must be short
        try:
            server.bind("socket.ipynb")
        finally:
            os.chdir(here)
        found = by_id(tmp_path)
    assert {name: each.rejection.partition(",")[0] for name, each in found.items() if each.rejection} == {
        "pipe": "pipe.py is a named pipe",
        "packed": "packed.zip is a named pipe",
        "folder": "folder.py is a folder",
        "socket": "socket.ipynb is a socket",
    }
    assert collect([tmp_path / "pipe.py", Path("/dev/zero")])[0].rejection


def test_a_link_out_of_its_folder_is_not_followed(tmp_path: Path) -> None:
    """Neither a secret outside nor another student's work is handed in through a link."""
    write(tmp_path, {"secret.py": "KEY = 1", "class/alice/slam1d.py": CODE, "class/bob/real.py": CODE})
    (tmp_path / "class" / "mallory").mkdir()
    (tmp_path / "class" / "mallory" / "slam1d.py").symlink_to("../alice/slam1d.py")
    (tmp_path / "class" / "eve").mkdir()
    (tmp_path / "class" / "eve" / "slam1d.py").symlink_to(tmp_path / "secret.py")
    (tmp_path / "class" / "dan").symlink_to("alice")
    (tmp_path / "class" / "gone").mkdir()
    (tmp_path / "class" / "gone" / "slam1d.py").symlink_to("nowhere")
    (tmp_path / "class" / "carl").mkdir()
    write(tmp_path / "class" / "carl", {"deep/work.txt": CODE})
    (tmp_path / "class" / "carl" / "slam1d.py").symlink_to("deep/work.txt")
    found = by_id(tmp_path / "class")
    words = "is a link that leads out of its folder; hand in the file itself."
    assert found["mallory"].rejection == found["eve"].rejection == f"slam1d.py {words}"
    assert found["dan"].rejection == "dan is a link to a folder; hand in the file itself."
    assert found["gone"].rejection == "slam1d.py is a link that leads nowhere; hand in the file itself."
    assert [name for name, each in found.items() if each.source] == ["alice", "bob", "carl"]


def test_a_link_that_the_user_names_is_followed(tmp_path: Path) -> None:
    """Whoever types a path has chosen it."""
    write(tmp_path, {"real/alice.py": CODE})
    (tmp_path / "link.py").symlink_to("real/alice.py")
    (tmp_path / "class").symlink_to("real")
    assert list(by_id(tmp_path / "link.py")) == ["link"]
    assert list(by_id(tmp_path / "class")) == ["alice"]


def test_a_file_that_refuses_to_be_opened_or_read_is_rejected(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Permissions and failing disks cost nobody else anything; the words of the system are given."""
    write(tmp_path, {"good.py": CODE, "shut.py": CODE, "torn.py": CODE})
    opened, real_open, real_read = {}, os.open, os.read

    def refuse(path: Path, flags: int) -> int:
        if Path(path).name == "shut.py":
            raise PermissionError(13, "Permission denied")
        descriptor = real_open(path, flags)
        opened[descriptor] = Path(path).name
        return descriptor

    def fail(descriptor: int, size: int) -> bytes:
        if opened.get(descriptor) == "torn.py":
            raise OSError(5, "Input/output error")
        return real_read(descriptor, size)

    monkeypatch.setattr(os, "open", refuse)
    monkeypatch.setattr(os, "read", fail)
    found = by_id(tmp_path)
    assert found["shut"].rejection == "shut.py cannot be opened (Permission denied); check its permissions."
    assert found["torn"].rejection == "torn.py cannot be read (Input/output error); check its permissions."
    assert found["good"].source is not None


@pytest.mark.skipif(os.geteuid() == 0, reason="root may read everything")
def test_an_unreadable_file_is_rejected(tmp_path: Path) -> None:
    """A file without permission costs nobody else anything."""
    write(tmp_path, {"good.py": CODE, "shut.py": CODE, "closed/x.py": CODE})
    (tmp_path / "shut.py").chmod(0)
    (tmp_path / "closed").chmod(0)
    found = by_id(tmp_path)
    (tmp_path / "closed").chmod(0o755)
    assert "cannot be opened (Permission denied)" in found["shut"].rejection
    assert "cannot be listed" in found["closed"].rejection
    assert found["good"].source is not None


def test_where_nothing_can_be_read_it_is_a_usage_error(tmp_path: Path) -> None:
    """A missing path, an empty folder and a folder without submissions each have their sentence."""
    write(tmp_path, {"papers/notes.md": "x"})
    (tmp_path / "empty").mkdir()
    for paths, words in [
        ([], "No path was given"),
        ([tmp_path / "missing"], "missing does not exist; check the path"),
        ([tmp_path / "empty"], "empty holds no submission; give .py, .ipynb or .zip files"),
        ([tmp_path / "papers"], "papers holds no submission"),
        ([Path("a\0b")], "does not exist|cannot be opened"),
    ]:
        with pytest.raises(UsageError, match=words):
            collect(paths)


def test_a_missing_path_beside_others_is_a_rejected_submission(tmp_path: Path) -> None:
    """Every other submission of the run is graded."""
    write(tmp_path, {"alice.py": CODE, "empty/notes.md": ""})
    found = by_id(tmp_path / "alice.py", tmp_path / "bob.py", tmp_path / "empty")
    assert found["alice"].source is not None
    assert found["bob.py"].rejection.startswith("bob.py does not exist")
    assert found["empty"].rejection.startswith("empty holds no submission")


def test_a_file_of_another_kind_says_what_is_expected(tmp_path: Path) -> None:
    """Handed-out files and documents are no submissions, also when named one by one."""
    write(tmp_path, {"posegraph.py": CODE, "report.pdf": "%PDF", "noext": "x = 1", "notes.docx": "PK\3\4"})
    found = by_id(*(tmp_path / name for name in ("posegraph.py", "report.pdf", "noext", "notes.docx")))
    assert found["posegraph"].rejection == "posegraph.py is a file that was handed out, not a submission."
    assert found["report"].rejection.startswith("report.pdf is a PDF document; hand in the .py or .ipynb file")
    assert found["noext"].rejection.startswith("noext is a file without a suffix, expected")


@pytest.mark.parametrize("name", ["ada", "ada.txt", "ada.py.txt", "ada.json", "ada.ipynb.txt", "Ada (1).PYW"])
@pytest.mark.parametrize("beside", [True, False])
def test_modules_and_notebooks_are_read_under_any_name(tmp_path: Path, name: str, beside: bool) -> None:
    """What is inside decides, for a file that is named, one in a folder of files and one in a student's folder."""
    for text in (CODE, notebook(cell())):
        write(tmp_path, {f"class/{name}": text, f"folders/ada/{name}": text, "folders/bob/slam1d.py": CODE})
        if beside:
            write(tmp_path, {"class/zoe.py": CODE})
        found = [*by_id(tmp_path / "class").values(), *by_id(tmp_path / "folders", layout="folder_a_student").values()]
        assert [each.rejection for each in found] == [""] * (4 if beside else 3)
        assert [each.rejection for each in by_id(tmp_path / "class" / name).values()] == [""]


@pytest.mark.parametrize(
    ("name", "data", "words"),
    [
        ("a.pdf", b"%PDF-1.4", "is a PDF document"),
        ("a.html", b"<html><pre>" + CODE.encode(), "is a web page"),
        ("a.md", b"# Mine\n```python\n" + CODE.encode() + b"```\n", "is a .md, expected one"),
        ("a", b"shall I compare thee", "is a file without a suffix, expected one"),
        ("a.txt", b"", "is empty"),
        ("a.txt", CODE.encode("utf-16"), "is text in UTF-16"),
        ("a.ipynb", CODE.encode("utf-16-le"), "is text in UTF-16"),
        ("a.dat", CODE.encode("utf-16-be"), "is text in UTF-16"),
        ("a.pyc", b"\x00\x01\x02", "is a binary file"),
        ("a.json", b'{"a": 1}', "is a .json, expected one"),
    ],
)
def test_what_is_neither_notebook_nor_module_has_its_row(tmp_path: Path, name: str, data: bytes, words: str) -> None:
    """Nothing that lies in a folder of files is dropped without a word."""
    write(tmp_path, {name: data, "zoe.py": CODE})
    found = by_id(tmp_path)
    assert sorted(found) == ["a", "zoe"]
    assert found["a"].rejection.startswith(f"{name} {words}")


def test_two_files_with_the_same_stem_get_distinct_names(tmp_path: Path) -> None:
    """Folders tell them apart where they differ, numbers otherwise; the renamed one says so."""
    write(tmp_path, {"hw.py": CODE, "hw.ipynb": notebook(cell()), "HW.zip": archive({"a.py": CODE})})
    found = by_id(tmp_path)
    assert list(found) == ["HW", "hw-2", "hw-3"]
    assert found["hw-2"].notes == ("Named hw-2 in the results; it was handed in as hw.",)
    write(tmp_path, {"one/x.py": CODE, "two/x.py": CODE})
    assert list(by_id(tmp_path / "one" / "x.py", tmp_path / "two" / "x.py")) == ["one-x", "two-x"]


def test_the_same_file_given_twice_is_one_submission(tmp_path: Path) -> None:
    """A folder and a file in it, or a file twice, are not two students."""
    write(tmp_path, {"class/alice.py": CODE})
    path = tmp_path / "class" / "alice.py"
    assert list(by_id(tmp_path / "class", path, path, tmp_path / "class" / ".." / "class")) == ["alice"]


def test_a_module_that_is_a_notebook_is_read_as_one(tmp_path: Path) -> None:
    """Any file name is accepted."""
    write(tmp_path, {"alice.py": notebook(cell("a = 1"))})
    found = by_id(tmp_path)["alice"]
    assert found.source == Source("notebook", ["a = 1"], "alice.py", ["cell 1"])
    assert found.notes == ("Read as a notebook: its content is one, whatever its name.",)


def test_hostile_file_names_become_safe_ids(tmp_path: Path) -> None:
    """No id leaves the folder of results, hides, or breaks a line."""
    names = ["..py", "-rf.py", "a\nb.py", "=1+1.py", "x" * 250 + ".py", "con.py", "Zoë Ω.py", "\u202egnp.py", "a\\b.py"]
    write(tmp_path, dict.fromkeys(names, CODE))
    surrogate = os.fsencode(tmp_path) + b"/\xff\xfe.py"
    Path(os.fsdecode(surrogate)).write_bytes(CODE.encode())
    found = by_id(tmp_path)
    assert len(found) == len(names)  # "..py" is a hidden file, the one of no encoding counts
    for each in found.values():
        assert each.id.isprintable()
        assert not set(each.id) & set('/\\:*?"<>|')
        assert each.id[0] not in ".-=+@ "
        assert len(each.id.encode()) <= 130
        assert each.path.isprintable()
        assert each.source is not None
        assert each.source.name.encode()
    assert "Zoë Ω" in found
    assert "_con" in found


@pytest.mark.parametrize("solved", ["slam1d.py", "slam1d.ipynb"])
def test_a_whole_folder_as_it_was_handed_out_is_read(tmp_path: Path, solved: str) -> None:
    """Of module and notebook the one counts in which something was begun; what was not graded is named."""
    folder = render_folder(worked_problem())
    first = 'raise NotImplementedError("residual is not finished yet'
    mark = json.dumps(first)[1:-1] if solved.endswith("ipynb") else first
    assert mark in folder[solved]
    folder[solved] = folder[solved].replace(mark, mark.replace("residual", "almost"))
    (tmp_path / "ada.zip").write_bytes(archive({f"ada/{name}": text for name, text in folder.items()}))
    (found,) = by_id(tmp_path).values()
    assert found.source is not None
    assert found.source.name == solved
    other = ({"slam1d.py", "slam1d.ipynb"} - {solved}).pop()
    assert any("also handed in and not graded: " in note and other in note for note in found.notes)


def test_a_whole_folder_with_both_begun_is_not_guessed_at(tmp_path: Path) -> None:
    """Where module and notebook were both worked in, a human has to say which counts."""
    both = {"slam1d.py": "x = 1\n", "slam1d.ipynb": notebook(cell("y = 2"))}
    (tmp_path / "ada.zip").write_bytes(archive(both))
    (found,) = by_id(tmp_path).values()
    assert "holds 2 submissions" in found.rejection
