"""A run on a real cluster: processes of dask's own command line, one of them killed, one submission a poison."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from autograder.course import load_course
from autograder.engine import members
from autograder.engine.grade import Progress, Run, Settings, grade
from autograder.errors import SandboxError, UsageError
from autograder.intake.submission import collect
from tests.engine.site import POISON, Site
from tests.engine.small_class import CLASS, agreed, make

pytest.importorskip("distributed", reason="the extra `cluster` is not installed")
pytestmark = pytest.mark.slow
SETTINGS = Settings(examples=1, time_limit=10.0, workers=2)


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Site]:
    """A scheduler without workers."""
    found = Site(tmp_path_factory.mktemp("site"))
    yield found
    found.close()


@pytest.fixture
def settings(site: Site) -> Iterator[Settings]:
    """Settings that name the scheduler; the workers of a test end with it."""
    yield replace(SETTINGS, scheduler=site.address)
    site.end_workers()


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the class."""
    texts = {f"{name}_{number}": f"# {number}\n{text}" for name, text in CLASS.items() for number in range(2)}
    return make(tmp_path_factory.mktemp("class"), texts)


def run(course: Path, out: Path, settings: Settings, on_progress: object = None) -> Run:
    """Grade the class."""
    submissions = collect([course / "uploads"])
    report = on_progress if callable(on_progress) else lambda _: None
    return grade(submissions, load_course(course / "course.toml"), settings, out, report)


def test_a_cluster_gives_the_results_of_this_machine(
    site: Site, settings: Settings, course: Path, tmp_path: Path
) -> None:
    """Two workers, one killed while it has submissions, another that joins: no byte of a result differs."""
    run(course, tmp_path / "local", SETTINGS)
    first, _ = site.worker(), site.worker()

    def kill_one(progress: Progress) -> None:
        if progress.done == 2:
            first.kill()
        if progress.done == 6:
            site.worker()

    here = run(course, tmp_path / "cluster", settings, kill_one)
    assert first.wait() == -9
    assert {result.status for result in here.results} == {"graded"}
    assert agreed(tmp_path / "cluster") == agreed(tmp_path / "local")


def test_a_poison_is_reported_and_not_retried_for_ever(
    site: Site, settings: Settings, course: Path, tmp_path: Path
) -> None:
    """Two workers die of it, the third grades everybody else."""
    folder = Path(shutil.copytree(course, tmp_path / "class"))
    (folder / "uploads/gil.py").write_text(f"x = '{POISON}'\n")
    workers = [site.worker() for _ in range(3)]
    results = {result.submission: result for result in run(folder, tmp_path / "out", settings).results}
    assert (results["gil"].status, results["gil"].score) == ("grader_error", None)
    assert "lost twice" in results["gil"].message
    assert {result.status for name, result in results.items() if name != "gil"} == {"graded"}
    assert sorted(process.poll() is None for process in workers) == [False, False, True]


def test_a_weaker_worker_gets_no_submission(site: Site, settings: Settings, course: Path, tmp_path: Path) -> None:
    """With a strong worker beside it the run goes on there; alone it is refused, and so is other software."""
    demanding = replace(settings, min_confinement="seccomp")
    site.worker({"CLAIMED_LEVEL": "none"})
    with pytest.raises(SandboxError, match="it confines at level none .*, seccomp is demanded"):
        run(course, tmp_path / "out", demanding)
    site.worker({"CLAIMED_LEVEL": "seccomp"})
    results = run(course, tmp_path / "out", demanding).results
    assert {result.confinement for result in results if result.status == "graded"} <= {"seccomp", "full"}
    site.end_workers()
    site.worker({"CLAIMED_NUMPY": "0.0"})
    with pytest.raises(SandboxError, match="None of the 1 workers .* it has numpy 0.0 instead of"):
        run(course, tmp_path / "again", settings)  # into the same folder nothing would have to be run


def test_no_scheduler_and_no_worker_are_said(site: Site, course: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The message says what was tried, what is expected and what to start."""
    monkeypatch.setattr(members, "CONNECT_SECONDS", 0.5)
    with pytest.raises(UsageError, match="no scheduler answers there .* expected an address such as tcp://host:8786"):
        members.connect("tcp://127.0.0.1:9")
    with pytest.raises(UsageError, match="expected an address"):
        members.connect("nonsense://")
    monkeypatch.setattr(members, "PATIENCE_SECONDS", 0.5)
    with pytest.raises(SandboxError, match="has no worker; start some with `dask worker tcp://"):
        run(course, course / "out", replace(SETTINGS, scheduler=site.address))
