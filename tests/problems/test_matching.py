"""Whose a submission is, and whose numbers it carries."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from autograder.owner import Owner
from autograder.problems.copied import Carried, Numbers
from autograder.problems.families import family
from autograder.problems.ledger import Ledger
from autograder.problems.matching import Match, Upload, match
from autograder.problems.roster import Student
from autograder.problems.secret import Secret
from autograder.problems.variants import Variant

AGAIN = "take away what does not count, and grade again"
CLASS = [
    Student("s1", "Ann Lee", "ann@x.edu"),
    Student("s1-b", "Bo Sö Lee", "bo@x.edu"),
    Student("s10", "Ann Lee", "ann.lee@x.edu"),
    Student("Zoë", "Zoë Müller", "zm@x.edu"),
    Student("ann@y.edu", "", ""),
]

PLACES = {
    "s1/slam1d.py": ("s1", "folder"),
    "class/S1/hw/slam1d.ipynb": ("s1", "folder"),
    "s1-b/slam1d.py": ("s1-b", "folder"),
    "hw/s1.py": ("s1", "file name"),
    "hw/slam1d_s10.final.py": ("s10", "file name"),
    "hw/(s1) slam1d.py": ("s1", "file name"),
    "Zoe\u0308/slam1d.py": ("Zoë", "folder"),
    "ann@y.edu/a.py": ("ann@y.edu", "folder"),
    "bo@x.edu/slam1d.py": ("s1-b", "folder"),
    "bo_123/slam1d.py": ("s1-b", "folder"),
    "Zoë Müller_17_assignsubmission_file/slam1d.py": ("Zoë", "folder"),
    "hw/mullerzoe_LATE_1234_5678_slam1d.py": ("Zoë", "file name"),
    "hw\\leeboso_1234.py": ("s1-b", "file name"),
    "s11/slam1d.py": (None, ""),
    "as1/slam1d.py": (None, ""),
    "Ann Lee_3/slam1d.py": (None, ""),  # two students have this name
    "slam1d.py": (None, ""),
    "": (None, ""),
}


@pytest.mark.parametrize(("path", "whose"), PLACES.items())
def test_a_place_names_a_student(path: str, whose: tuple[str | None, str]) -> None:
    """Folder first, then file name; an id stands by itself, the longer one counts, a shared name does not."""
    (found,) = match([Upload("u", path)], CLASS)
    assert (found.student_id, found.by) == whose
    assert bool(found.note) == (found.student_id is None)


def test_a_folder_is_believed_and_what_contradicts_is_said() -> None:
    """The folder of the course is believed before the student's own folders and files; the difference is said."""
    place = Owner(place="s10")
    found = match([Upload("a", "hw/s10/s1-b/zoe.py", owner=place), Upload("b", "s10/s1-b.py")], CLASS)
    assert [(item.student_id, item.by) for item in found] == [("s10", "folder")] * 2
    assert found[0].note == f"the folder names s1-b; s10 has 2 submissions (a, b): {AGAIN}"
    assert found[1].note == f"the file name names s1-b; s10 has 2 submissions (a, b): {AGAIN}"


ROSTER = [
    Student("s1001", "Jane Doe", "jane@x.edu"),
    Student("s1002", "John Roe", "john@x.edu", {"Canvas ID": "77"}),
    Student("1", "Kim Law", "kim@x.edu"),
    Student("4711", "Ann Lee", ""),
    Student("4712", "Ann Lee", ""),
    Student("s7", "Plato", "@plato:matrix.example"),
    Student("s8", "Zoë O'Neil-Lu", "n/a"),
    Student("s9", "", ""),
]
SPOKEN = {
    "a partner's id in the file name": (Owner("Canvas", name="doejane", number="101"), "with_s1002.py", "s1001", True),
    "Canvas's suffix": (Owner("Canvas", name="doejane", number="101"), "slam1d-1.py", "s1001", False),
    "a number of Moodle that is somebody's id": (Owner("Moodle", name="Jane Doe", number="1"), "a.py", "s1001", False),
    "the SID": (Owner("Gradescope", "s1001", "jane@x.edu", "J. D."), "s1002.py", "s1001", True),
    "the address": (Owner("Gradescope", "", "john@x.edu", "Johnny"), "slam1d.py", "s1002", False),
    "an address that is another's": (Owner("Gradescope", "s1001", "john@x.edu", ""), "slam1d.py", "s1001", True),
    "a column of the roster": (Owner("Canvas", name="roe", number="77"), "slam1d.py", "s1002", False),
    "that column, another system": (Owner("Moodle", name="Roe", number="77"), "slam1d.py", None, True),
    "a shared name": (Owner("Canvas", name="leeann", number="9"), "4711.py", None, True),
    "a shared name, numbered": (Owner("Canvas", name="leeann", number="4712"), "slam1d.py", "4712", False),
    "one word": (Owner("Moodle", name="Plato", number="3"), "slam1d.py", "s7", False),
    "signs and accents": (Owner("Canvas", name="oneilluzo", number="4"), "slam1d.py", "s8", False),
    "a group before the name": (Owner("Moodle", name="Team 1-Jane Doe", number="5"), "slam1d.py", "s1001", False),
    "blind": (Owner("Moodle", name="Participant", number="1"), "slam1d.py", None, True),
    "no name in the roster": (Owner("Canvas", name="poecy", number="s9"), "slam1d.py", "s9", False),
    "nothing said": (Owner("Gradescope"), "s1002.py", None, True),
    "nobody": (Owner("Canvas", name="doejane", number="2", nobody="a test"), "slam1d.py", None, True),
    "nbgrader's login": (Owner("nbgrader", "john"), "s1001.ipynb", "s1002", True),
}


@pytest.mark.parametrize(("owner", "file", "whose", "noted"), SPOKEN.values(), ids=SPOKEN.keys())
def test_what_the_platform_says_wins(owner: Owner, file: str, whose: str | None, noted: bool) -> None:
    """Nothing that the student wrote, and no other system's number, overrides it; a disagreement is a note."""
    (found,) = match([Upload("u", f"s1002/submission_1/1/{file}", owner=owner)], ROSTER)
    assert (found.student_id, bool(found.note)) == (whose, noted), found


@given(st.sampled_from(ROSTER[:3]), st.text(max_size=20), st.sampled_from(ROSTER), st.text(max_size=9))
def test_no_name_of_a_file_overrides_the_platform(student: Student, before: str, other: Student, after: str) -> None:
    """Whatever a student calls the file, and whatever a notebook says, it stays theirs."""
    owner = Owner("Gradescope", student.student_id, student.email, student.name)
    file = f"{before}{other.student_id}{after}.py"
    (found,) = match([Upload("u", f"e/{file}", other.student_id, owner, file)], ROSTER)
    assert found.student_id == student.student_id
    assert (other.student_id in found.note) == (other != student)


def test_word_of_the_staff_comes_first() -> None:
    """What staff have decided holds against everything."""
    upload = Upload("u", "s1002.py", owner=Owner("Canvas", name="doejane", number="1"))
    (found,) = match([upload], ROSTER, given={"u": "4711"})
    assert (found.student_id, found.by) == ("4711", "word of the course staff")


def test_metadata_come_last() -> None:
    """The notebook's metadata count where the place says nothing: an id, or a variant on record."""
    uploads = [
        Upload("a", "hw/a.ipynb", "s10"),
        Upload("b", "s1/b.ipynb", "s10"),
        Upload("c", "hw/c.ipynb", "A-123"),
        Upload("d", "hw/d.ipynb", "A-999"),
    ]
    found = match(uploads, CLASS, {"A-123": "zoë"})
    assert found[1].note == "the notebook metadata name s10"
    assert [(item.student_id, item.by) for item in found] == [
        ("s10", "notebook metadata"),
        ("s1", "folder"),
        ("Zoë", "notebook metadata"),
        (None, ""),
    ]


def test_doubt_is_said() -> None:
    """Two ids in one place decide nothing; two submissions of one student are both said."""
    both, alone, again, nobody = match(
        [
            Upload("a", "s1 and s10/x.py"),
            Upload("b", "s1/x.py"),
            Upload("c", "hw/s1.py"),
            Upload("d", "s1_s10.py", "Zoë"),
        ],
        CLASS,
    )
    assert both == Match("a", None, "", "the folder names s1 and s10; it names nobody of the roster")
    assert alone == Match("b", "s1", "folder", f"s1 has 2 submissions (b, c): {AGAIN}")
    assert again == Match("c", "s1", "file name", f"s1 has 2 submissions (b, c): {AGAIN}")
    assert nobody == Match("d", "Zoë", "notebook metadata", "the file name names s1 and s10")


@given(
    st.lists(st.from_regex(r"[a-z0-9][a-z0-9._@-]{0,8}[a-z0-9]", fullmatch=True), min_size=1, max_size=8, unique=True)
)
@settings(max_examples=60)
def test_everybody_is_found_in_their_own_folder(ids: list[str]) -> None:
    """Whatever ids a class has, a released folder with a submission in it is matched to its student."""
    found = match([Upload(one, f"{one}/slam1d.py") for one in ids], [Student(one) for one in ids])
    assert [(item.student_id, item.by) for item in found] == [(one, "folder") for one in ids]


SECRET = Secret(b"0123456789abcdef")


@pytest.fixture(scope="module")
def variants() -> list[Variant]:
    """Draw a class of three families; two students have the worked example."""
    letters = "AWLCEE"
    return Ledger().extend(SECRET, "2026S", {f"s{k}": family(letter) for k, letter in enumerate(letters)})


def test_own_numbers_are_never_flagged(variants: list[Variant]) -> None:
    """Right answers on one's own variant, and the data of one's own stub, belong to nobody else."""
    numbers = Numbers(variants)
    for variant in variants:
        assert numbers.in_answers(variant.student_id, variant.iterates) == []
        assert numbers.in_text(variant.student_id, repr(variant.graph.measurements.tolist())) == []


def test_somebody_elses_answers_are_flagged(variants: list[Variant]) -> None:
    """The answer and the start of another variant are recognised, up to float noise, and named."""
    numbers, other = Numbers(variants), variants[0]
    found = numbers.in_answers("s1", other.iterates + 1e-12)
    assert found == [Carried(("s0",), "the start x^(0)"), Carried(("s0",), "the answer x^(1)")]
    assert found[1].text() == "The answer x^(1): the numbers of s0."
    assert numbers.in_answers(None, other.iterates[1:2]) == [Carried(("s0",), "the answer x^(1)")]
    assert numbers.in_answers("s1", other.iterates + 0.01) == []


def test_odd_answers_are_nobodys(variants: list[Variant]) -> None:
    """No number, a huge one, or another length is no reason to suspect anybody."""
    numbers = Numbers(variants)
    for odd in (np.full((4, 5), np.nan), np.full((4, 5), 1e300), np.zeros((4, 0)), np.zeros((0, 5)), np.zeros((4, 5))):
        assert numbers.in_answers("s1", odd) == []


def test_somebody_elses_data_are_flagged(variants: list[Variant]) -> None:
    """Another student's measurements are recognised wherever they stand in a source, in their order."""
    numbers, other = Numbers(variants), variants[3]
    source = f"n = 6; u = np.array({other.graph.measurements.tolist()})  # 1e999, 12abc, .5.5"
    assert numbers.in_text("s0", source) == [Carried(("s3",), "the measurements in the source")]
    assert numbers.in_text("s3", source) == []
    assert numbers.in_text("s0", source.replace(", ", "\n,\t")) == [Carried(("s3",), "the measurements in the source")]
    assert numbers.in_text("s0", repr(other.graph.measurements[::-1].tolist())) == []


def test_the_worked_example_is_nobodys(variants: list[Variant]) -> None:
    """The worked example stands in every handout; carrying it means nothing."""
    numbers, example = Numbers(variants), variants[4]
    assert example.identifier == "worked-example"
    assert numbers.in_answers("s0", example.iterates) == []
    assert numbers.in_text("s0", repr(example.graph.measurements.tolist())) == []
