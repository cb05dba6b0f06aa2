"""A disk that is full, a folder that cannot be written, a file cut by a crash: a clear sentence, nothing believed."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from autograder.engine.store import Store
from autograder.errors import UsageError
from autograder.verdicts import decode
from autograder.writing import write_whole
from tests.engine.small_class import CLASS, agreed, command, make

NOBODY = 65534
needs_root = pytest.mark.skipif(os.geteuid() != 0 or shutil.which("mount") is None, reason="only root mounts a disk")
SOME = {name: CLASS[name] for name in ("ada", "bob", "finn")}


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the class."""
    return make(tmp_path_factory.mktemp("no_room"), SOME)


@pytest.fixture(scope="module")
def calm(course: Path) -> Path:
    """The output folder of a run that has room."""
    subprocess.run(command(course, course / "calm"), check=True, capture_output=True)
    return course / "calm"


@pytest.fixture
def disk(tmp_path: Path) -> Iterator[Path]:
    """A disk in memory that a test may make small, large or read-only."""
    place = tmp_path / "disk"
    place.mkdir()
    if subprocess.run(["mount", "-t", "tmpfs", "tmpfs", str(place)], check=False, capture_output=True).returncode:
        pytest.skip("this machine lets nobody mount a disk")
    yield place
    subprocess.run(["umount", str(place)], check=True)


def remount(disk: Path, options: str) -> None:
    """Change a disk that is mounted."""
    subprocess.run(["mount", "-o", f"remount,{options}", str(disk)], check=True)


def refused(words: list[str]) -> str:
    """Run a command that fails, and return its last words: one line, no traceback."""
    ended = subprocess.run(words, capture_output=True, text=True, check=False)
    assert ended.returncode == 2, ended.stderr
    assert "Traceback" not in ended.stderr
    return ended.stderr.splitlines()[-1]


def whole(out: Path, calm: Path) -> bool:
    """Whether every result of a run is one of the undisturbed run."""
    wanted, found = agreed(calm), agreed(out)
    return all(wanted[name] == found[name] for name in found if name.startswith("results/"))


@needs_root
@pytest.mark.slow
@pytest.mark.parametrize("share", [0.4, 1.3], ids=["among the results", "among the reports"])
def test_a_full_disk_is_said_and_the_run_goes_on_when_there_is_room(
    course: Path, calm: Path, disk: Path, share: float
) -> None:
    """Exit code 2 and one sentence; the results that are there are whole; with room the same command ends the work."""
    results = sum(-(-path.stat().st_size // 4096) * 4096 for path in (calm / "results").iterdir())
    remount(disk, f"size={int(share * results)}")
    said = refused(command(course, disk / "out"))
    assert "could not be written (No space left on device)" in said
    assert whole(disk / "out", calm)
    remount(disk, "size=64m")
    subprocess.run(command(course, disk / "out"), check=True, capture_output=True)
    assert agreed(disk / "out") == agreed(calm)


@needs_root
@pytest.mark.slow
def test_a_read_only_disk_is_said_before_anything_is_graded(course: Path, calm: Path, disk: Path) -> None:
    """The folder is tried before the work; what it holds stays as it is."""
    shutil.copytree(calm, disk / "out")
    remount(disk, "ro")
    assert "cannot be written" in refused([*command(course, disk / "out"), "--fresh"])
    assert "choose another" in refused(command(course, disk / "other"))
    assert agreed(disk / "out") == agreed(calm)


def test_a_folder_of_somebody_else_is_refused_at_once() -> None:
    """A user who may read a folder and not write it is told so."""
    with tempfile.TemporaryDirectory() as name:  # pytest's own folders are closed to others
        folders = [Path(name), Path(name, "results")]
        folders[1].mkdir()
        for folder in folders:
            folder.chmod(0o555)
        if os.geteuid() == 0:
            os.seteuid(NOBODY)
        try:
            with pytest.raises(UsageError, match="cannot be written by this user; choose another with -o"):
                Store(Path(name))
        finally:
            os.seteuid(os.getuid())
            for folder in folders:
                folder.chmod(0o755)


def test_a_file_that_cannot_be_written_leaves_the_old_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A device that is always full stands for any disk: the sentence names the file and the reason."""
    (tmp_path / "old").write_bytes(b"as it was")
    monkeypatch.setattr("autograder.writing._for_the_owner", lambda _: os.open("/dev/full", os.O_WRONLY))
    with pytest.raises(UsageError, match=r"old could not be written \(No space left on device\)"):
        write_whole(tmp_path / "old", b"new" * 10000)
    assert [path.name for path in tmp_path.iterdir()] == ["old"]
    assert (tmp_path / "old").read_bytes() == b"as it was"


@pytest.mark.slow
def test_a_result_cut_anywhere_is_not_believed(course: Path, calm: Path, tmp_path: Path) -> None:
    """Whatever prefix of a file a crash has left, it counts as no result, and the next run makes it anew."""
    out = tmp_path / "out"
    shutil.copytree(calm, out)
    path = out / "results" / "bob.json"
    data = path.read_bytes()
    fingerprint = decode(data).fingerprint
    for length in range(0, len(data) - 1, 97):
        path.write_bytes(data[:length])
        assert Store(out).load("bob", fingerprint) is None, length
    subprocess.run(command(course, out), check=True, capture_output=True)
    assert agreed(out) == agreed(calm)


def test_drafts_of_killed_processes_are_swept(tmp_path: Path) -> None:
    """What a killed process was writing goes away with the next run; what somebody else writes now stays."""
    results = tmp_path / "results"
    results.mkdir()
    gone = subprocess.Popen(["true"])
    gone.wait()
    for writer in (gone.pid, os.getppid()):
        (results / f".ada.json.{writer}.part").touch()
    Store(tmp_path)
    assert [path.name for path in results.iterdir()] == [f".ada.json.{os.getppid()}.part"]
