"""A run over a class: nothing lost, nothing run twice, the same marks whoever runs it."""

import json
import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time
from dataclasses import replace
from pathlib import Path

import pytest

from autograder.course import Course
from autograder.engine.grade import Settings, grade
from autograder.engine.store import Store
from autograder.engine.worker import Examiner
from autograder.errors import SandboxError, UsageError
from autograder.intake.submission import collect
from autograder.problems.conclusion import RIGHT, choices
from tests.engine.conftest import REFERENCE

SETTINGS = Settings(examples=10, time_limit=0.3, workers=2)
COURSE = Course()
ANSWERS = """

iterates = np.array([[0, 1.1, 2.1, 3.2, 0.5], *[[0, 1.0, 1.9, 2.9, 0.1]] * 3])
conclusion = "{letter}"
written_2 = "The second step is zero."
written_3 = "f is linear in x."
""".format(letter=next(choice.letter for choice in choices("worked-example") if choice.identifier == RIGHT))
FULL = 105.0  # all but the written answers, and both bonus stages
CLASS = {
    "ada": REFERENCE + ANSWERS,
    "bob": REFERENCE.replace("1.0 / variances", "variances"),
    "cleo": REFERENCE + "\n\ndef residual(x, graph):\n    return 1 / 0\n",
    "dan": "x = 1\n",
    "eve": REFERENCE.replace("-1.0", "1.0"),
}


@pytest.fixture
def uploads(tmp_path):
    """A folder with five submissions."""
    folder = tmp_path / "uploads"
    folder.mkdir()
    for name, text in CLASS.items():
        (folder / f"{name}.py").write_text(text)
    return folder


def stripped(out):
    """Return all results without the seconds, and the record without its timings."""
    results = {}
    for path in sorted((out / "results").iterdir()):
        data = json.loads(path.read_bytes())
        del data["seconds"]
        results[path.name] = data
    return results


def test_every_submission_has_a_result(uploads, tmp_path):
    """Results are on disk as they are in the run, sorted, with the marks that the work deserves."""
    run = grade(collect([uploads]), COURSE, SETTINGS, tmp_path / "out")
    assert [result.submission for result in run.results] == sorted(CLASS)
    scores = {result.submission: result.score for result in run.results}
    assert (scores["ada"], run.results[0].max_score) == (FULL, 100.0)
    assert (run.results[0].provisional, run.results[0].awaiting) == (True, 5.0)
    assert scores["dan"] == 0
    assert 0 < scores["bob"] < 100
    store = Store(tmp_path / "out")
    assert tuple(store.read(name) for name in sorted(CLASS)) == run.results
    record = json.loads((tmp_path / "out/run.json").read_bytes())
    assert record["seed"] == 0
    assert record["confinement"] in {"full", "seccomp"}
    assert record["locks"] == run.results[0].locks
    assert "andlock" in record["locks"]  # there, or said to be missing
    assert record["graded_now"] == 5


def test_one_worker_and_two_agree(uploads, tmp_path):
    """The number of workers and the order in which they finish change no byte but the seconds."""
    for workers in (1, 2):
        grade(collect([uploads]), COURSE, replace(SETTINGS, workers=workers), tmp_path / f"out{workers}")
    assert stripped(tmp_path / "out1") == stripped(tmp_path / "out2")


def test_a_second_run_runs_nothing(uploads, tmp_path):
    """Unchanged work is reused; --fresh runs it again, with the same results."""
    out = tmp_path / "out"
    first = grade(collect([uploads]), COURSE, SETTINGS, out)
    again = grade(collect([uploads]), COURSE, SETTINGS, out)
    assert (again.record.graded_now, again.record.reused) == (0, 5)
    assert again.results == first.results
    fresh = grade(collect([uploads]), COURSE, replace(SETTINGS, fresh=True), out)
    assert (fresh.record.graded_now, fresh.record.reused) == (5, 0)


@pytest.mark.parametrize("change", ["seed", "examples", "points", "time limit"])
def test_a_changed_rule_is_noticed(uploads, tmp_path, change):
    """Another seed, other points, another limit: everything is graded again."""
    out = tmp_path / "out"
    submissions = collect([uploads])[:1]
    grade(submissions, COURSE, SETTINGS, out)
    settings, course = {
        "seed": (replace(SETTINGS, seed=1), COURSE),
        "examples": (replace(SETTINGS, examples=11), COURSE),
        "points": (SETTINGS, replace(COURSE, points={**COURSE.points, "residual": 20.0})),
        "time limit": (replace(SETTINGS, time_limit=0.4), COURSE),
    }[change]
    assert grade(submissions, course, settings, out).record.graded_now == 1


def test_a_changed_upload_is_noticed(uploads, tmp_path):
    """Only the submission that changed is graded again."""
    out = tmp_path / "out"
    grade(collect([uploads]), COURSE, SETTINGS, out)
    (uploads / "dan.py").write_text(REFERENCE + ANSWERS)
    run = grade(collect([uploads]), COURSE, SETTINGS, out)
    assert (run.record.graded_now, run.record.reused) == (1, 4)
    assert run.results[3].score == FULL


@pytest.mark.parametrize("damage", [b"", b"{", b'{"submission": "ada"}', b"null", b"\xff\xfe"])
def test_a_damaged_result_is_not_believed(uploads, tmp_path, damage):
    """A result file that is no result is graded again."""
    out = tmp_path / "out"
    submissions = collect([uploads])[:1]
    grade(submissions, COURSE, SETTINGS, out)
    path = out / "results/ada.json"
    whole = path.read_bytes()
    path.write_bytes(damage or whole[: len(whole) // 2])
    assert grade(submissions, COURSE, SETTINGS, out).results[0].score == FULL


def test_a_rejected_upload_scores_zero_and_says_why(uploads, tmp_path):
    """The others are graded; the reason stands in the result."""
    (uploads / "zoe.ipynb").write_text("this is no notebook")
    run = grade(collect([uploads]), COURSE, SETTINGS, tmp_path / "out")
    rejected = run.results[-1]
    assert (rejected.status, rejected.score) == ("rejected", 0.0)
    assert rejected.message
    assert len(run.results) == 6


def test_a_weaker_confinement_than_demanded_is_refused(uploads, tmp_path, monkeypatch):
    """Nothing is graded below the level that the course demands."""
    monkeypatch.setattr("autograder.engine.crew.LEVELS", ("full", "none", "seccomp"))
    with pytest.raises(SandboxError, match="autograder doctor"):
        grade(collect([uploads]), COURSE, SETTINGS, tmp_path / "out")
    assert not list((tmp_path / "out/results").iterdir())


def test_an_output_folder_that_is_a_file_is_refused(uploads, tmp_path):
    """The message names the path and says what to do."""
    (tmp_path / "out").write_text("a file")
    with pytest.raises(UsageError, match="choose another with -o"):
        grade(collect([uploads]), COURSE, SETTINGS, tmp_path / "out")


def test_a_killed_worker_loses_nothing(uploads, tmp_path):
    """Its submission runs again in another worker; the results are those of an undisturbed run."""
    grade(collect([uploads]), COURSE, SETTINGS, tmp_path / "calm")
    killed = []

    def kill_one(_):
        if not killed:
            children = f"/proc/{os.getpid()}/task/{os.getpid()}/children"
            with open(children) as file:
                workers = [int(pid) for pid in file.read().split() if b"spawn_main" in _command(pid)]
            killed.append(workers[0])
            os.kill(workers[0], signal.SIGKILL)

    grade(collect([uploads]), COURSE, SETTINGS, tmp_path / "rough", kill_one)
    assert killed
    assert stripped(tmp_path / "rough") == stripped(tmp_path / "calm")


def _command(pid):
    with open(f"/proc/{pid}/cmdline", "rb") as file:
        return file.read()


def test_ctrl_c_keeps_what_is_done(uploads, tmp_path):
    """The command ends with 130; the next run goes on from there."""
    (uploads / "slow.py").write_text("def residual(x, graph):\n    while True:\n        pass\n")
    command = [sys.executable, "-m", "autograder", "grade", str(uploads), "-o", str(tmp_path / "out")]
    options = ["--examples", "10", "--time-limit", "5", "--workers", "1"]
    process = subprocess.Popen(
        [*command, *options],
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # noqa: PLW1509 - test runners ignore it
    )
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline and len(list((tmp_path / "out/results").glob("*.json"))) < 5:
        time.sleep(0.05)
    os.killpg(process.pid, signal.SIGINT)  # as a terminal does: to everybody in the group
    _, stderr = process.communicate(timeout=30)
    assert process.returncode == 130, stderr
    assert "Traceback" not in stderr
    assert json.loads((tmp_path / "out/run.json").read_bytes())["interrupted"] is True
    assert len(list((tmp_path / "out/results").glob("*.json"))) == 5


def _asked(monkeypatch, text, tmp_path, settings=SETTINGS):
    """Grade one submission in this process; return its stages by name, and for each run whether it was alone."""
    runs = []
    do = Examiner.do

    def seen(examiner, job):
        runs.append(job.alone)
        return do(examiner, job)

    monkeypatch.setattr(Examiner, "do", seen)
    (tmp_path / "slow.py").write_text(text)
    run = grade(collect([tmp_path / "slow.py"]), COURSE, settings, tmp_path / "out")
    return {stage.name: stage for stage in run.results[0].stages}, runs


def test_computing_time_that_is_used_up_needs_no_second_run(tmp_path, monkeypatch):
    """An endless loop has run out of time, however busy the machine was; what calls it is not waited for in full."""
    monkeypatch.setattr("autograder.sandbox.channel.WALL_FACTOR", 1000.0)  # the clock is no judge on a busy machine
    loop = "\n\ndef residual(x, graph):\n    while True:\n        pass\n"
    began = time.perf_counter()
    stages, runs = _asked(monkeypatch, REFERENCE + loop, tmp_path)
    assert runs == [False]
    assert stages["residual"].status == "timeout"
    assert "0.3 s of computing" in stages["residual"].message
    assert "0.03 s of computing" in stages["gauss_newton_step"].message
    assert "residual had hung before" in stages["gauss_newton_step"].message
    assert stages["jacobian"].status == "passed"
    assert time.perf_counter() - began < 60  # a bound for a hang of the test itself, no claim of speed


def test_time_by_the_clock_alone_is_confirmed_once(tmp_path, monkeypatch):
    """Whoever sleeps uses no computing time; that is believed after a second run with a processor of its own."""
    nap = "import time\n\ndef residual(x, graph):\n    time.sleep(100)\n"
    stages, runs = _asked(monkeypatch, REFERENCE + nap, tmp_path, replace(SETTINGS, time_limit=0.1))
    assert runs == [False, True]
    assert stages["residual"].status == "timeout"
    assert stages["jacobian"].status == "passed"


def test_a_second_run_does_not_hold_up_the_others(uploads, tmp_path):
    """While a sleeper is confirmed, workers that have a processor go on with the rest of the class."""
    (uploads / "a_sleeper.py").write_text(REFERENCE + "import time\n\ndef residual(x, graph):\n    time.sleep(100)\n")
    order = []
    run = grade(collect([uploads]), COURSE, SETTINGS, tmp_path / "out", lambda at: order.append(at.submission))
    assert order[-1] == "a_sleeper"
    assert run.results[0].stages[0].status == "timeout"


BUSY = "import time\nend = time.monotonic() + 300\nwhile time.monotonic() < end:\n    pass\n"
HONEST = """

def _slowly(function):
    def called(*arguments):
        for _ in range(29):
            function(*arguments)
        return function(*arguments)
    return called


for _name in ("residual", "jacobian", "information_matrix", "normal_equations"):
    globals()[_name] = _slowly(globals()[_name])
"""


@pytest.mark.slow
def test_honest_slow_code_keeps_its_points_on_a_busy_machine(tmp_path):
    """Thirty times the work of the reference, beside eight processes that want every processor, costs nothing."""
    (tmp_path / "slow.py").write_text(REFERENCE + HONEST)
    others = [subprocess.Popen([sys.executable, "-c", BUSY]) for _ in range(8)]
    try:
        run = grade(collect([tmp_path / "slow.py"]), COURSE, Settings(examples=60), tmp_path / "out")
    finally:
        for each in others:
            each.kill()
            each.wait()
    lost = [stage.name for stage in run.results[0].stages if stage.status != "passed"]
    assert lost == ["answers", "written"]


def test_nothing_of_the_run_is_left(uploads, tmp_path):
    """No worker process and no thread stays behind."""
    before = threading.active_count()
    grade(collect([uploads]), COURSE, SETTINGS, tmp_path / "out")
    with open(f"/proc/{os.getpid()}/task/{os.getpid()}/children") as file:
        assert not [pid for pid in file.read().split() if b"spawn_main" in _command(pid)]
    assert threading.active_count() == before


def test_a_worker_computes_in_one_thread(uploads, tmp_path, monkeypatch):
    """What numpy reads when it is loaded is set in a worker, and the client's own environment stays as it was."""
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "7")
    monkeypatch.delenv("OMP_NUM_THREADS", raising=False)
    found = []

    def look(_):
        for each in multiprocessing.active_children():
            words = Path(f"/proc/{each.pid}/environ").read_bytes().split(b"\0")
            found.append({b"OPENBLAS_NUM_THREADS=1", b"OMP_NUM_THREADS=1"} <= set(words))

    grade(collect([uploads]), COURSE, SETTINGS, tmp_path / "out", look)
    assert found
    assert all(found)
    assert os.environ["OPENBLAS_NUM_THREADS"] == "7"
    assert "OMP_NUM_THREADS" not in os.environ


SLOW = """

_plain = residual


def residual(x, graph):
    for _ in range({}):
        pass
    return _plain(x, graph)
"""


def test_what_is_slow_but_in_time_check_by_check_keeps_its_marks(tmp_path):
    """All checks of residual together take longer than the limit, none of them by itself does."""
    folder = tmp_path / "uploads"
    folder.mkdir()
    began = time.process_time()
    for _ in range(10**6):
        pass
    loops = int(0.02 / (time.process_time() - began) * 10**6)  # 20 ms a call: 30 of them a check at the most
    (folder / "slow.py").write_text(REFERENCE + SLOW.format(loops))
    run = grade(collect([folder]), COURSE, replace(SETTINGS, examples=1, time_limit=0.6), tmp_path / "out")
    (stage,) = (stage for stage in run.results[0].stages if stage.name == "residual")
    assert stage.status == "passed"
