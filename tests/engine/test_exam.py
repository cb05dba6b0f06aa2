"""The exam file: what it keeps, and that nothing but a whole file of this homework is taken for one."""

from __future__ import annotations

import hashlib
import subprocess
import sys
import zlib
from dataclasses import replace
from pathlib import Path

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.course import Course
from autograder.engine import exam as exams
from autograder.engine.exam import Exam, draw_exam, exam_of, kept_exam, read_exam, save_exam
from autograder.engine.grade import Settings, grade
from autograder.engine.kept import pack
from autograder.engine.laid_out import plan_of_exam
from autograder.engine.plan import make_plan
from autograder.errors import UsageError
from autograder.intake.submission import collect
from autograder.problems.cases import key
from autograder.stages.catalogue import all_stages
from autograder.stages.residual import Residual
from tests.engine.conftest import REFERENCE

COURSE = Course()
SETTINGS = Settings(examples=5, workers=2)


@pytest.fixture(scope="module")
def drawn() -> Exam:
    """A small exam."""
    return draw_exam(7, 5)


@pytest.fixture
def uploads(tmp_path: Path) -> Path:
    """Two submissions."""
    folder = tmp_path / "uploads"
    folder.mkdir()
    for name in ("ada", "bob"):
        (folder / f"{name}.py").write_text(REFERENCE)
    return folder


def test_a_file_gives_back_what_was_drawn(drawn: Exam, tmp_path: Path) -> None:
    """Cases, seed and digest come back to the bit, and the bytes of the file are those of the exam."""
    save_exam(drawn, tmp_path / "exam")
    again = read_exam(tmp_path / "exam")
    assert (again.seed, again.examples, again.homework) == (7, 5, "slam1d")
    assert again.digest == drawn.digest
    assert (tmp_path / "exam").read_bytes() == again.data
    for ladder, rungs in drawn.corpus.cases.items():
        for rung, cases in rungs.items():
            assert [key(case) for case in again.corpus.cases[ladder][rung]] == [key(case) for case in cases]


@given(data=st.data())
def test_a_damaged_file_is_one_sentence(data: st.DataObject) -> None:
    """However a file is cut or changed, it is refused in one or two sentences that say what to do."""
    whole = draw_exam(7, 5).data
    place = data.draw(st.integers(0, len(whole) - 1))
    damaged = data.draw(
        st.sampled_from(
            [whole[:place], whole[:place] + bytes([whole[place] ^ 0x11]) + whole[place + 1 :], whole + b"x", whole[1:]]
        )
    )
    with pytest.raises(UsageError) as refused:
        exam_of(damaged, "midterm.exam")
    assert str(refused.value).startswith("midterm.exam ")
    assert "autograder exam -o FILE" in str(refused.value)
    assert "\n" not in str(refused.value)


def _with(drawn: Exam, **changes: object) -> bytes:
    """Write an exam whose body says something else, with a checksum that fits."""
    body = msgspec.msgpack.decode(zlib.decompress(drawn.data.split(b"\n", 2)[2]))
    packed = zlib.compress(msgspec.msgpack.encode(body | changes))
    return b"autograder exam 1\n" + hashlib.sha256(packed).hexdigest().encode() + b"\n" + packed


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"homework": "slam2d"}, "an exam of the homework slam2d, and slam1d is graded here"),
        ({"content": "0" * 64}, "another edition of slam1d"),
        ({"seed": "seven"}, "cannot read"),
    ],
)
def test_a_foreign_or_older_exam_is_named_as_such(drawn: Exam, changes: dict[str, object], words: str) -> None:
    """A file that is whole but of something else is refused for that reason."""
    with pytest.raises(UsageError, match=words):
        exam_of(_with(drawn, **changes), "x.exam")


def test_another_format_is_named_as_such(drawn: Exam) -> None:
    """A file of a later grader says which format it has."""
    with pytest.raises(UsageError, match="format 2, and this autograder reads format 1"):
        exam_of(drawn.data.replace(b"exam 1\n", b"exam 2\n", 1), "x.exam")


def test_the_exam_is_kept_and_taken_again(uploads: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The first run keeps its exam; the second draws none and runs nobody's code."""
    out = tmp_path / "out"
    first = grade(collect([uploads]), COURSE, SETTINGS, out)
    kept = kept_exam(out)
    assert kept is not None
    assert {result.exam for result in first.results} == {kept.digest}

    def never(*_: object) -> None:
        raise AssertionError("nothing is drawn and no worker is started where nothing is new")

    monkeypatch.setattr("autograder.engine.grade.draw_exam", never)
    monkeypatch.setattr("autograder.engine.grade.crew", never)
    again = grade(collect([uploads]), COURSE, SETTINGS, out)
    assert again.results == first.results
    assert (again.record.reused, again.record.confinement) == (2, first.record.confinement)


def test_everybody_is_graded_on_the_exam_that_is_given(drawn: Exam, uploads: Path, tmp_path: Path) -> None:
    """A given exam replaces the kept one, and each result says which exam it is of."""
    out = tmp_path / "out"
    grade(collect([uploads]), COURSE, SETTINGS, out)
    run = grade(collect([uploads]), COURSE, SETTINGS, out, exam=drawn)
    assert run.record.graded_now == 2
    assert {result.exam for result in run.results} == {drawn.digest}
    assert {result.seed for result in run.results} == {7}
    assert (out / "exam").read_bytes() == drawn.data


def test_a_damaged_kept_exam_stops_before_anything_is_lost(uploads: Path, tmp_path: Path) -> None:
    """Results stay as they were; the sentence names the file."""
    out = tmp_path / "out"
    grade(collect([uploads]), COURSE, SETTINGS, out)
    before = {path.name: path.read_bytes() for path in (out / "results").iterdir()}
    (out / "exam").write_bytes((out / "exam").read_bytes()[:-1])
    with pytest.raises(UsageError, match="damaged"):
        grade(collect([uploads]), COURSE, replace(SETTINGS, fresh=True), out)
    assert {path.name: path.read_bytes() for path in (out / "results").iterdir()} == before


def test_grading_with_a_file_never_imports_hypothesis(drawn: Exam, uploads: Path, tmp_path: Path) -> None:
    """A grader that has its exam needs no Hypothesis."""
    save_exam(drawn, tmp_path / "x.exam")
    code = (
        "import sys; sys.modules['hypothesis'] = None\n"
        "from pathlib import Path\n"
        "from autograder.course import Course\n"
        "from autograder.engine.exam import read_exam\n"
        "from autograder.engine.grade import Settings, grade\n"
        "from autograder.intake.submission import collect\n"
        "if __name__ == '__main__':\n"
        "    paths = [Path(word) for word in sys.argv[1:]]\n"
        "    run = grade(collect(paths[:1]), Course(), Settings(workers=1), paths[1], exam=read_exam(paths[2]))\n"
        "    print(*(result.status for result in run.results))\n"
    )
    script = tmp_path / "script.py"
    script.write_text(code)
    done = subprocess.run(
        [sys.executable, script, uploads, tmp_path / "out", tmp_path / "x.exam"],
        capture_output=True,
        text=True,
        check=True,
        cwd=Path(exams.__file__).parents[2],
        env={"PATH": "/usr/bin:/bin", "PYTHONPATH": str(Path(exams.__file__).parents[2])},
    )
    assert done.stdout.split() == ["graded", "graded"]


def test_the_answers_are_in_the_file(drawn: Exam) -> None:
    """What a verdict needs comes back to the bit as it was worked out; the calls come back in their order."""
    stages = all_stages()
    points = {stage.name: stage.points for stage in stages}
    fresh = make_plan(stages, points, drawn.corpus)
    kept = plan_of_exam(exam_of(drawn.data, "x"), [stage.name for stage in stages], points, 1.0)
    assert kept.inputs == fresh.inputs
    assert [task.rung.name for task in kept.tasks] == [task.rung.name for task in fresh.tasks]
    for one, other in zip((*kept.tasks, *kept.apart), (*fresh.tasks, *fresh.apart), strict=True):
        assert one.answers
        assert pack(one.prepared) == pack(other.prepared)
        assert (one.batch, one.numbers, one.asked.tolist()) == (other.batch, other.numbers, other.asked.tolist())
        assert [key(case) for case in one.cases] == [key(case) for case in other.cases]
    for bundle, again in zip(kept.bundles, fresh.bundles, strict=True):
        assert (bundle.batch, bundle.ends) == (again.batch, again.ends)
    for gallery, again in zip(kept.galleries, fresh.galleries, strict=True):
        assert (gallery.stage, gallery.batch, len(gallery.cases)) == (again.stage, again.batch, len(again.cases))
    assert kept.objects == fresh.objects


def test_other_code_lays_the_calls_out_anew(drawn: Exam, monkeypatch: pytest.MonkeyPatch) -> None:
    """A later grader makes the calls as it does, and takes cases and answers from the file."""
    monkeypatch.setattr("autograder.engine.laid_out.code_digest", lambda: "another")
    monkeypatch.setattr(Residual, "expected", lambda *_: pytest.fail("the answers are in the file"))
    plan = plan_of_exam(drawn, ["residual"], {"residual": 15.0}, 1.0)
    assert plan.tasks[0].prepared.data.size > 0


def test_a_file_that_unfolds_without_end_is_refused(drawn: Exam, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is decompressed is bounded, whatever the file holds."""
    monkeypatch.setattr(exams, "_LARGEST", 1000)
    with pytest.raises(UsageError, match="cannot read"):
        exam_of(drawn.data, "x.exam")


def test_an_exam_that_another_hypothesis_drew_is_taken_as_it_is(uploads: Path, tmp_path: Path) -> None:
    """A file drawn under the lowest version that is allowed grades under this one; nothing is drawn again."""
    exam = read_exam(Path(__file__).with_name("drawn_with_hypothesis_6_131.exam"))
    assert exam.drawn_with["hypothesis"] == "6.131.0"
    run = grade(collect([uploads]), COURSE, SETTINGS, tmp_path / "out", exam=exam)
    assert {result.exam for result in run.results} == {exam.digest}
    assert all(stage.status in {"passed", "missing"} for result in run.results for stage in result.stages)
    assert kept_exam(tmp_path / "out") == exam
