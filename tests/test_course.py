"""The course file: defaults, the template, and errors that name key and line."""

from __future__ import annotations

import contextlib
import tempfile
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.course import COURSE_TEMPLATE, DEFAULT_POINTS, STAGES, Course, load_course, write_course
from autograder.course.lines import line_of
from autograder.course.schema import KEYS
from autograder.errors import UsageError


def load(folder: Path, text: str) -> Course:
    """Load a course file of this text."""
    path = folder / "course.toml"
    path.write_text(text, encoding="utf-8")
    return load_course(path)


def complaint(folder: Path, text: str) -> str:
    """Return what is said about a course file of this text."""
    with pytest.raises(UsageError) as raised:
        load(folder, text)
    return str(raised.value).replace(str(folder / "course.toml"), "course.toml")


def test_without_a_file_the_defaults_of_the_contract_hold() -> None:
    """The stages that exist are worth 90 points."""
    course = load_course(None)
    assert course == Course()
    assert course.max_score == 100.0
    assert course.points == {
        "residual": 15,
        "jacobian": 15,
        "information_matrix": 10,
        "normal_equations": 20,
        "gauss_newton_step": 20,
        "second_step": 10,
        "answers": 5,
        "written": 5,
        "sparsity_pattern": 5,
        "range_factor": 5,
    }


def test_the_template_loads_to_the_defaults(tmp_path: Path) -> None:
    """The file to start from changes nothing by itself."""
    write_course(tmp_path / "course.toml")
    assert load_course(tmp_path / "course.toml") == Course()


def test_the_template_names_and_explains_every_setting() -> None:
    """Each key stands in the template, and every section has a comment before its first key ends."""
    for section, keys in KEYS.items():
        assert not section or f"[{section}]" in COURSE_TEMPLATE
        for key in keys:
            assert any(line.removeprefix("# ").split(" ")[0] == key for line in COURSE_TEMPLATE.splitlines()), key
    comments = sum(line.startswith("#") for line in COURSE_TEMPLATE.splitlines())
    assert comments >= sum(map(len, KEYS.values()))


def test_the_template_is_not_written_over_a_file(tmp_path: Path) -> None:
    """What a teacher has edited is never lost."""
    path = tmp_path / "course.toml"
    path.write_text("mine", encoding="utf-8")
    with pytest.raises(UsageError, match="is there already and was not changed"):
        write_course(path)
    assert path.read_text(encoding="utf-8") == "mine"
    with pytest.raises(UsageError, match="folder does not exist"):
        write_course(tmp_path / "none" / "course.toml")


def test_every_setting_is_read(tmp_path: Path) -> None:
    """Each key lands in its field; stages come in the order of the homework."""
    course = load(
        tmp_path,
        """
        title = "Robotics 1"
        points.residual = 7.5
        points.answers = 0
        [grading]
        stages = ["jacobian", "residual"]
        follow_through = 1
        bonus_cap = 100
        examples = 50
        seed = 2026
        [limits]
        time = 0.5
        memory = 256
        output = 1
        [feedback]
        policy = "hint"
        [confinement]
        minimum = "full"
        """,
    )
    assert course == Course(
        title="Robotics 1",
        points={**DEFAULT_POINTS, "residual": 7.5, "answers": 0.0},
        stages=("residual", "jacobian"),
        follow_through=1.0,
        bonus_cap=100.0,
        examples=50,
        seed=2026,
        time_limit=0.5,
        memory_mib=256,
        output_mib=1,
        feedback="hint",
        min_confinement="full",
    )
    assert course.max_score == 22.5


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            "# a\n[points]\njacobain = 5\n",
            "course.toml, line 3: [points] jacobain is not known; did you mean jacobian?",
        ),
        ("[point]\n", "course.toml, line 1: point is not known; did you mean points?"),
        ("\nexamples = 5\n", "course.toml, line 2: examples is not known; it belongs into [grading]."),
        ("[limits]\npolicy = 5\n", "course.toml, line 2: [limits] policy is not known; it belongs into [feedback]."),
        ("xyzzy = 5\n", "course.toml, line 1: xyzzy is not known; known here are title, points, grading, "),
        (
            '[points]\nresidual = "15"\n',
            'course.toml, line 2: [points] residual is "15", expected a number from 0 to 1000.',
        ),
        ("[points]\nresidual = nan\n", "line 2: [points] residual is nan, expected"),
        ("[points]\nresidual = true\n", "line 2: [points] residual is true, expected"),
        ("[points]\nresidual = -1\n", "line 2: [points] residual is -1, expected"),
        ("points = 5\n", "line 1: points is 5, expected a section that begins with [points]."),
        ("[points]\nx.y = 5\n", "line 2: [points] x is not known"),
        ("[grading]\nstages = [\n'residual',\n'residual']\n", "line 2: [grading] stages is ['residual', 'residual']"),
        ("[grading]\nstages = []\n", "line 2: [grading] stages is [], expected a list of different stages out of"),
        ("[grading]\nseed = 1.5\n", "line 2: [grading] seed is 1.5, expected a whole number"),
        (
            "[grading]\n\nbonus_cap = 90\n",
            "line 3: [grading] bonus_cap is 90, below the 100 points that there are without bonus",
        ),
        ("[grading]\nexamples = 0\n", "line 2: [grading] examples is 0, expected"),
        ("[limits]\ntime = 0\n", "line 2: [limits] time is 0, expected seconds, more than 0"),
        ('[feedback]\npolicy = "all"\n', 'line 2: [feedback] policy is "all", expected "full", "hint" or "score".'),
        ("[limits]\ntime = {a = 1}\n", "line 2: [limits] time is a section, expected"),
        ("[points]\nresidual = \n", "course.toml, line 2: is no valid TOML (Invalid value)."),
        ("[points]\n[points]\n", "course.toml, line 2: is no valid TOML (Cannot declare ('points',) twice)."),
        ('title = """', "course.toml: is no valid TOML"),
        ("title = " + "[" * 5000, "is nested too deeply"),
        ("seed = " + "9" * 5000, "is no valid TOML"),
        ("#" * 70_000, "is larger than 64 KiB"),
        ("[grading]\nstages = ['residual']\n[points]\nresidual = 0\n", "the stages in use have no points"),
    ],
)
def test_an_error_names_key_and_line(tmp_path: Path, text: str, expected: str) -> None:
    """What came, what was expected, and where."""
    assert expected in complaint(tmp_path, text)


def test_a_course_file_that_cannot_be_read_is_said(tmp_path: Path) -> None:
    """A missing file, a folder and a file in another encoding each have their sentence."""
    with pytest.raises(UsageError, match="does not exist; `autograder init"):
        load_course(tmp_path / "none.toml")
    with pytest.raises(UsageError, match="is no file"):
        load_course(tmp_path)
    path = tmp_path / "latin.toml"
    path.write_bytes(b"\n# caf\xe9\n")
    with pytest.raises(UsageError, match="line 2: is not UTF-8"):
        load_course(path)


def test_a_mark_of_utf8_and_windows_line_ends_are_read(tmp_path: Path) -> None:
    """An editor of Windows may save the file."""
    path = tmp_path / "course.toml"
    path.write_bytes(b"\xef\xbb\xbf[grading]\r\nseed = 3\r\n")
    assert load_course(path).seed == 3


@given(
    st.lists(
        st.sampled_from(["", "# note", "    ", 'a = """\nb = 1\n"""', "c = [\n1,\n# x\n2]", "d.e = 1"]), unique=True
    )
)
def test_the_line_of_a_key_is_found_behind_whatever_stands_before_it(before: list[str]) -> None:
    """Comments, blank lines and values of several lines do not disturb the count."""
    head = "\n".join(before) + "\n" if before else ""
    assert line_of(f"{head}wanted = 5\nafter = 6\n", ("wanted",)) == head.count("\n") + 1


@given(st.text(st.sampled_from("[]{}=.\"'\n#a1 residualpoints,"), max_size=200))
def test_no_text_makes_the_loader_fail_in_another_way(text: str) -> None:
    """Whatever the file holds, the error is ours."""
    with tempfile.TemporaryDirectory() as folder:  # tmp_path would live longer than one example
        path = Path(folder) / "course.toml"
        path.write_text(text, encoding="utf-8")
        with contextlib.suppress(UsageError):
            assert set(load_course(path).stages) <= set(STAGES)


def test_the_due_date_and_extensions_are_moments(tmp_path: Path) -> None:
    """A date, a time and an offset; names of the course's own in [extensions]."""
    course = load(
        tmp_path,
        "[late]\ndue = 2026-11-20T23:59:00+01:00\nper_day = 10\n"
        '[extensions]\nada = 2026-11-27T23:59:00+01:00\n"Zoë 7" = 2026-11-28T23:59:00Z\n',
    )
    assert course.due is not None
    assert course.due.isoformat() == "2026-11-20T23:59:00+01:00"
    assert list(course.extensions) == ["ada", "Zoë 7"]
    assert course.late_per_day == 10


@pytest.mark.parametrize("value", ["2026-11-20", "2026-11-20T23:59:00", '"2026-11-20T23:59:00Z"', "7", "23:59:00"])
@pytest.mark.parametrize(("section", "key"), [("late", "due"), ("extensions", "ada")])
def test_a_moment_without_an_offset_is_refused(tmp_path: Path, section: str, key: str, value: str) -> None:
    """Midnight of which country would be anybody's guess."""
    said = complaint(tmp_path, f"[{section}]\n{key} = {value}\n")
    assert said.startswith(f"course.toml, line 2: [{section}] {key} is ")
    assert "2026-11-20T23:59:00+01:00" in said


def test_points_of_questions_add_up_to_their_stage(tmp_path: Path) -> None:
    """One may be left out: it gets the rest."""
    assert load(tmp_path, "[written]\nquestion_2 = 1\n").question_points == {"2": 1.0, "3": 4.0}
    assert load(tmp_path, "[written]\nquestion_2 = 5\n").question_points == {"2": 5.0, "3": 0.0}
    for text in ("question_2 = 6", "question_2 = 2\nquestion_3 = 2"):
        assert "do not add up to the 5 points of written" in complaint(tmp_path, f"[written]\n{text}\n")


def test_what_only_reports_apply_changes_no_verdict() -> None:
    """A due date or a title is no reason to run a class again; points are."""
    assert Course(title="other", late_per_day=5).judging() == Course().judging()
    assert Course(follow_through=0.4).judging() != Course().judging()
